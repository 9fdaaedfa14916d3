// Searches that ask every daughter (see searches.h), either one after the other or four boxes at
// once.
namespace navjit::kernels {

/// Asks every daughter, one after the other; for scenes with few daughters.
struct SearchAll {
  template <class Daughters>
  [[gnu::always_inline]] int find(const Daughters& d, const Vec3<double>& p,
                                  const Direction<double>& v, int blocked, double tol) const {
    if constexpr (Daughters::listed > 0) {
      return find_listed<Daughters::listed>(d, p, v, blocked, tol);
    } else {
      for (unsigned k = d.count; k-- > 0;) {
        if (static_cast<int>(k) != blocked && d.holds(k, p, v, tol)) return static_cast<int>(k);
      }
      return -1;
    }
  }
  template <class Daughters>
  [[gnu::always_inline]] int nearest(const Daughters& d, const Vec3<double>& p,
                                     const Direction<double>& v, double& best, double limit,
                                     unsigned, double tol) const {
    int hit = -1;
    if constexpr (Daughters::listed > 0) {
      nearest_listed<0>(d, p, v, best, limit, tol, hit);
    } else {
      for (unsigned k = 0; k < d.count; ++k) {
        const double t = d.distance(k, p, v, smaller(limit, best), tol);
        if (t < best) {
          best = t;
          hit = static_cast<int>(k);
        }
      }
    }
    return hit;
  }

 private:
  /// The last of the first `n` daughters that holds the point.
  template <unsigned n, class Daughters>
  [[gnu::always_inline]] static int find_listed(const Daughters& d, const Vec3<double>& p,
                                                const Direction<double>& v, int blocked,
                                                double tol) {
    if constexpr (n == 0) {
      return -1;
    } else {
      constexpr int k = n - 1;
      if (blocked != k && d.template holds_one<n - 1>(p, v, tol)) return k;
      return find_listed<n - 1>(d, p, v, blocked, tol);
    }
  }
  /// The nearest of the daughters from `k` on.
  template <unsigned k, class Daughters>
  [[gnu::always_inline]] static void nearest_listed(const Daughters& d, const Vec3<double>& p,
                                                    const Direction<double>& v, double& best,
                                                    double limit, double tol, int& hit) {
    if constexpr (k < Daughters::listed) {
      const double t = d.template distance_one<k>(p, v, smaller(limit, best), tol);
      if (t < best) {
        best = t;
        hit = static_cast<int>(k);
      }
      nearest_listed<k + 1>(d, p, v, best, limit, tol, hit);
    }
  }
};

/// A find that is out of line and takes numbers, so that this rare case keeps none of the caller's
/// values in memory.
template <class Search, class Daughters>
[[gnu::noinline, gnu::cold]] int find_seldom(const Search& search, const Daughters& d, double x,
                                             double y, double z, double u, double v, double w,
                                             int blocked, double tol) {
  return search.find(d, Vec3<double>{x, y, z}, make_heading<double>(u, v, w), blocked, tol);
}

/// For scenes in which all daughters are boxes along the axes: tests all of them, four at once.
/// `Fours` says where the boxes are.
template <class Fours>
struct SearchLanes {
  [[no_unique_address]] Fours fours;

  template <class Daughters>
  [[gnu::always_inline]] int find(const Daughters& d, const Vec3<double>& p,
                                  const Direction<double>& v, int blocked, double tol) const {
    if (__builtin_expect(!is_oblique(v), 0)) {
      return find_seldom(SearchAll{}, d, p.x, p.y, p.z, v.x, v.y, v.z, blocked, tol);
    }
    return last_box_at(fours.boxes(), p, v, tol, blocked);
  }
  template <class Daughters>
  [[gnu::always_inline]] int nearest(const Daughters& d, const Vec3<double>& p,
                                     const Direction<double>& v, double& best, double limit,
                                     unsigned left, double tol) const {
    if constexpr (knows_oblique<Daughters>) {
      int hit = -1;
      nearest_of_boxes(fours.boxes(), p, v, tol, best, hit);
      return hit;
    } else {
      return SearchAll{}.nearest(d, p, v, best, limit, left, tol);
    }
  }
};

/// The boxes are in memory.
template <int n>
struct FoursAt {
  const FourBoxes (*at)[n];
  const FourBoxes (&boxes() const)[n] { return *at; }
};
template <const auto& fours>
struct ConstantFours {
  static const auto& boxes() { return fours; }
};

}  // namespace navjit::kernels
