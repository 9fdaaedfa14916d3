// Leaves that share code: of each its solid's numbers and its frame are data, and all else is
// constant, what there is beside them in the module included. Where tracks go from one kind of leaf
// to another and back, as in a calorimeter, code of each leaf's own would cost more than it gains:
// which of them is called next the processor does not foresee.
namespace navjit::kernels {

/// At the data of such a leaf; its own numbers are behind this.
struct SharedLeafData {
  const void* module;  ///< the data of all scenes of the module
};

/// As LeaveToScene, out of such a leaf.
template <class S>
struct LeaveSharedLeafTo {
  [[gnu::always_inline]] static void go(const void* data, NavigationStack* stack,
                                        const Context* context, double x, double y, double z,
                                        unsigned left) {
    --stack->depth;
    reenter_scene<S>(static_cast<const SharedLeafData*>(data)->module, stack, context, x, y, z,
                     left);
  }
};

}  // namespace navjit::kernels
