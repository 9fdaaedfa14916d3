// Searches whose numbers are constants, except for their tables, which are too large for code.
namespace navjit::kernels {

// with_tables: the search `known`, with the tables of `tables`.

template <class Index>
[[gnu::always_inline]] inline SearchSlabs<Index> with_tables(SearchSlabs<Index> known,
                                                             const SearchSlabs<Index>& tables) {
  const SlabRow<Index>& t = tables.slabs;
  SlabRow<Index>& s = known.slabs;
  s.low = t.low;
  s.high = t.high;
  s.daughter = t.daughter;
  s.position = t.position;
  s.ascending = t.ascending;
  s.descending = t.descending;
  return known;
}
template <class Index>
[[gnu::always_inline]] inline SearchGrid<Index> with_tables(SearchGrid<Index> known,
                                                            const SearchGrid<Index>& tables) {
  known.grid.first = tables.grid.first;
  known.grid.members = tables.grid.members;
  return known;
}
template <class Index>
[[gnu::always_inline]] inline SearchBoxes<Index> with_tables(SearchBoxes<Index> known,
                                                             const SearchBoxes<Index>& tables) {
  known.grid.first = tables.grid.first;
  known.grid.blocks = tables.grid.blocks;
  known.grid.daughters = tables.grid.daughters;
  return known;
}
[[gnu::always_inline]] inline SearchScan with_tables(SearchScan known, const SearchScan& tables) {
  known.blocks = tables.blocks;
  return known;
}
template <class Index>
[[gnu::always_inline]] inline Beside<Index> with_tables(Beside<Index> known,
                                                        const Beside<Index>& tables) {
  known.few = tables.few;
  known.blocks = tables.blocks;
  known.in_block = tables.in_block;
  return known;
}
template <class Index>
[[gnu::always_inline]] inline SearchNest<Index> with_tables(SearchNest<Index> known,
                                                            const SearchNest<Index>& tables) {
  known.shells.near2 = tables.shells.near2;
  known.shells.far2 = tables.shells.far2;
  known.shells.daughter = tables.shells.daughter;
  known.beside = with_tables(known.beside, tables.beside);
  return known;
}
template <class Index>
[[gnu::always_inline]] inline SearchRings<Index> with_tables(SearchRings<Index> known,
                                                             const SearchRings<Index>& tables) {
  known.rings = tables.rings;
  known.beside = with_tables(known.beside, tables.beside);
  return known;
}

/// A search whose numbers are constants, except for its tables.
template <const auto& known>
struct ConstantSearch {
  decltype(with_tables(known, known)) tables;

  [[gnu::always_inline]] auto search() const { return with_tables(known, tables); }

  template <class Daughters>
  [[gnu::always_inline]] int find(const Daughters& d, const Vec3<double>& p,
                                  const Direction<double>& v, int blocked, double tol) const {
    return search().find(d, p, v, blocked, tol);
  }
  template <class Daughters>
  [[gnu::always_inline]] int nearest(const Daughters& d, const Vec3<double>& p,
                                     const Direction<double>& v, double& best, double limit,
                                     unsigned left, double tol) const {
    using Search = decltype(search());
    if constexpr (requires { &Search::search; }) {
      return Search::nearest_by(*this, d, p, v, best, limit, left, tol);
    } else {
      return search().nearest(d, p, v, best, limit, left, tol);
    }
  }
};

}  // namespace navjit::kernels
