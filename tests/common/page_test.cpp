// Pages: no name becomes markup, and nothing is fetched from elsewhere.
#include "common/page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace navjit::common {
namespace {

constexpr auto npos = std::string::npos;
const std::string hostile = "</td><script>alert('x')</script>\"onload=\"&\x1b\xff";

TEST(Page, NamesAreNoMarkup) {
  Chart chart{hostile, hostile, {{hostile, {{0, 1}, {1, 2}}}}, {{0.5, 1, hostile}}, hostile};
  const std::string html = page_html(
      hostile, heading_html(hostile) + paragraph_html(hostile) + facts_html({{hostile, hostile}}) +
                   table_html({hostile}, {{{hostile}}}) + shares_html({{hostile, 1.0}}) +
                   picture_html("png", hostile) + chart_html(chart));
  EXPECT_EQ(html.find("<script>alert"), npos);
  EXPECT_EQ(html.find("\"onload"), npos);
  EXPECT_EQ(html.find('\x1b'), npos);
  EXPECT_EQ(html.find('\xff'), npos);
  EXPECT_NE(html.find("&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;&quot;onload"), npos);
  // One script, that of all pages; nothing from outside.
  EXPECT_EQ(html.find("<script>"), html.rfind("<script>"));
  EXPECT_EQ(html.find("://"), npos);
}

TEST(Page, CellsAreSortedByTheirNumbers) {
  const std::string html = table_html(
      {"a", "b"}, {{counted(1234567), measured(0, "%.1f")}, {{"x"}, measured(2.25, "%.1f")}});
  EXPECT_NE(html.find("data-v=\"1234567\">1,234,567<"), npos) << html;
  EXPECT_NE(html.find("data-v=\"2.25\">2.2<"), npos) << html;
  EXPECT_NE(html.find("<td class=\"n\">-<"), npos) << html;
  EXPECT_EQ(counted(12).text, "12");
  EXPECT_EQ(counted(123).text, "123");
  EXPECT_EQ(measured(std::numeric_limits<double>::infinity(), "%.1f").text, "-");
}

TEST(Page, ChartsOfNothingAreASentence) {
  EXPECT_NE(chart_html({"x", "y", {}}).find("too short"), npos);
  EXPECT_NE(chart_html({"x", "y", {{"one", {{1, 1}}}}}).find("too short"), npos);
  const std::string flat =
      chart_html({"x", "y", {{"zero", {{0, 0}, {0, 0}}}}, {{7, 9, "far"}}, "m"});
  EXPECT_EQ(flat.find("nan"), npos) << flat;
  EXPECT_EQ(flat.find("inf"), npos) << flat;
}

/// The coordinate pairs of the first of its lines, as text.
std::string points_of(const std::string& html) {
  const std::size_t at = html.find("points=\"") + 8;
  return html.substr(at, html.find('"', at + 1) - at);
}

TEST(Page, LogarithmicAxesHaveWholeDecades) {
  Chart chart{"x", "y", {{"one", {{0, 5}, {0.02, 1}, {0.2, 0}, {2, 1e-3}}}}};
  chart.x_scale = chart.y_scale = Scale::logarithmic;
  const std::string html = chart_html(chart);
  // From 0.01 to 10, and from 0.001 to 10: all labels, and what is 0 left out.
  for (const char* label : {">0.01<", ">0.1<", ">1<", ">10<", ">0.001<"}) {
    EXPECT_NE(html.find(label), npos) << label << html;
  }
  EXPECT_EQ(html.find(">100<"), npos);
  const std::string points = points_of(html);
  EXPECT_EQ(std::count(points.begin(), points.end(), ','), 2) << points;
  EXPECT_EQ(html.find("nan"), npos);
  EXPECT_EQ(html.find("inf"), npos);
  // A decade is as long as another.
  Chart straight{"x", "y", {{"one", {{1, 1}, {10, 10}, {100, 100}}}}};
  straight.x_scale = straight.y_scale = Scale::logarithmic;
  std::istringstream in(points_of(chart_html(straight)));
  std::vector<double> x, y;
  char comma = 0;
  for (double a = 0, b = 0; in >> a >> comma >> b;) {
    x.push_back(a);
    y.push_back(b);
  }
  ASSERT_EQ(x.size(), 3U);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.11);
  EXPECT_NEAR(y[1] - y[0], y[2] - y[1], 0.11);
  EXPECT_LT(y[2], y[0]);
}

TEST(Page, DotsAreAtThePoints) {
  Chart chart{"x", "y", {{"one", {{1, 1}, {1, 2}}}}};
  EXPECT_EQ(chart_html(chart).find("<circle"), npos);
  chart.dots = true;
  const std::string html = chart_html(chart);
  EXPECT_NE(html.find("<circle"), html.rfind("<circle"));
}

}  // namespace
}  // namespace navjit::common
