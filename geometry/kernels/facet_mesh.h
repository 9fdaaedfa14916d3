// A closed surface of triangles, and the boxes around them.
namespace navjit::kernels {

/// Indices of the corners, anticlockwise seen from outside.
struct Facet {
  int a, b, c;
};

/// A box around the facets from `first` to first + count - 1, if it is a leaf; if count is 0,
/// around the boxes within it.
template <class Real>
struct FacetBox {
  Real x_low, y_low, z_low, x_high, y_high, z_high;
  int first, count;
  int next;  ///< the box that follows the boxes within this one
};

/// The largest number of boxes on the way from the outermost box to a leaf.
constexpr int most_facet_levels = 32;

template <class Real>
struct Facets {
  const Vec3<Real>* corners;
  int corner_count;
  const Facet* facets;
  int facet_count;
  const FacetBox<Real>* boxes;  ///< depth first
  int box_count;
  const FacetGroup<Real>* groups;  ///< the same hierarchy, eight boxes wide; the first is the root
  int group_count;
  const FacetLeaf<Real>* leaves;
  int leaf_count;
};

}  // namespace navjit::kernels
