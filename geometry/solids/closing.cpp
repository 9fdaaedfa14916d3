#include "geometry/solids/closing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace navjit::detail {
namespace {

using kernels::Facet;
using Edge = std::pair<int, int>;

std::array<Edge, 3> edges_of(const Facet& f) { return {{{f.a, f.b}, {f.b, f.c}, {f.c, f.a}}}; }

/// How often each edge runs from its lower to its higher corner, less how often it runs back; edges
/// whose count is 0 are left out.
std::map<Edge, int> unbalanced_edges(const std::vector<Facet>& facets) {
  std::map<Edge, int> edges;
  for (const Facet& f : facets) {
    for (const auto& [from, to] : edges_of(f)) edges[std::minmax(from, to)] += from < to ? 1 : -1;
  }
  std::erase_if(edges, [](const auto& e) { return e.second == 0; });
  return edges;
}

std::size_t leave_out_doubled(std::vector<Facet>& facets) {
  std::set<std::array<int, 3>> known;
  return std::erase_if(facets, [&](const Facet& f) {
    std::array<int, 3> key{f.a, f.b, f.c};
    std::sort(key.begin(), key.end());
    return !known.insert(key).second;
  });
}

double area(const std::vector<Vec3>& corners, const Facet& f) {
  const Vec3& a = corners[static_cast<std::size_t>(f.a)];
  const Vec3 u = kernels::difference(corners[static_cast<std::size_t>(f.b)], a);
  const Vec3 v = kernels::difference(corners[static_cast<std::size_t>(f.c)], a);
  return std::hypot(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
}

/// Turns the facets that face the other way than most of the area that they are connected with, by
/// edges that exactly two facets have.
std::size_t turn_round(const std::vector<Vec3>& corners, std::vector<Facet>& facets) {
  std::map<Edge, std::vector<std::size_t>> users;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    for (const auto& [from, to] : edges_of(facets[i])) users[std::minmax(from, to)].push_back(i);
  }
  const auto runs = [&](std::size_t i, const Edge& edge) {
    const auto edges = edges_of(facets[i]);
    return std::find(edges.begin(), edges.end(), edge) != edges.end();
  };
  enum : signed char { unknown = 0, as_first = 1, against_first = -1 };
  std::vector<signed char> way(facets.size(), unknown);
  std::size_t turned = 0;
  for (std::size_t first = 0; first < facets.size(); ++first) {
    if (way[first] != unknown) continue;
    way[first] = as_first;
    std::vector<std::size_t> part{first};
    for (std::size_t next = 0; next < part.size(); ++next) {
      const std::size_t i = part[next];
      for (const Edge& edge : edges_of(facets[i])) {
        const auto& both = users[std::minmax(edge.first, edge.second)];
        if (both.size() != 2) continue;
        const std::size_t other = both[0] == i ? both[1] : both[0];
        if (way[other] != unknown) continue;
        way[other] = static_cast<signed char>(runs(other, edge) ? -way[i] : way[i]);
        part.push_back(other);
      }
    }
    double with = 0, against = 0;
    for (const std::size_t i : part) {
      (way[i] == as_first ? with : against) += area(corners, facets[i]);
    }
    const signed char wrong = against > with ? as_first : against_first;
    for (const std::size_t i : part) {
      if (way[i] != wrong) continue;
      std::swap(facets[i].b, facets[i].c);
      ++turned;
    }
  }
  return turned;
}

/// Spans every loop of open edges by triangles from one of its corners. The open edges are the
/// boundary of a surface: as many lead to each corner as from it, so that they form loops.
std::size_t span_loops(std::vector<Facet>& facets) {
  std::map<int, std::vector<int>> onwards;  // the edges that are missing
  for (const auto& [edge, count] : unbalanced_edges(facets)) {
    const auto [from, to] = count > 0 ? Edge{edge.second, edge.first} : edge;
    onwards[from].insert(onwards[from].end(), static_cast<std::size_t>(std::abs(count)), to);
  }
  const std::size_t before = facets.size();
  for (auto& [start, ways] : onwards) {
    while (!ways.empty()) {
      std::vector<int> path{start};
      std::map<int, std::size_t> place{{start, 0}};
      while (!path.empty()) {
        std::vector<int>& open = onwards[path.back()];
        if (open.empty()) break;
        const int to = open.back();
        open.pop_back();
        const auto met = place.find(to);
        if (met == place.end()) {
          place[to] = path.size();
          path.push_back(to);
          continue;
        }
        // The path is back at a corner: what lies between the two visits is a loop.
        const std::size_t from = met->second;
        for (std::size_t i = from + 1; i + 1 < path.size(); ++i) {
          facets.push_back({path[from], path[i], path[i + 1]});
        }
        for (std::size_t i = from + 1; i < path.size(); ++i) place.erase(path[i]);
        path.resize(from + 1);
      }
    }
  }
  return facets.size() - before;
}

std::string counted(std::size_t count, const char* what) {
  return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

}  // namespace

std::size_t open_edges(const std::vector<Facet>& facets) { return unbalanced_edges(facets).size(); }

Closing close_facets(const std::vector<Vec3>& corners, std::vector<Facet>& facets) {
  Closing closing;
  closing.open_edges = open_edges(facets);
  if (closing.open_edges == 0) return closing;
  closing.doubled = leave_out_doubled(facets);
  closing.turned = turn_round(corners, facets);
  closing.added = span_loops(facets);
  return closing;
}

std::string describe(const Closing& closing) {
  if (closing.open_edges == 0) return {};
  std::string done;
  const auto add = [&](const char* verb, std::size_t count, const char* what) {
    if (count > 0) done += (done.empty() ? "" : ", ") + (verb + counted(count, what));
  };
  add("left out ", closing.doubled, "doubled facet");
  add("turned ", closing.turned, "facet");
  add("added ", closing.added, "facet");
  return "open at " + counted(closing.open_edges, "edge") + "; " + done;
}

}  // namespace navjit::detail
