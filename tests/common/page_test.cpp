// Pages: nothing in a name is markup, and nothing is fetched from elsewhere.
#include "common/page.hpp"

#include <gtest/gtest.h>

#include <limits>

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

}  // namespace
}  // namespace navjit::common
