// Leaves that share code. The numbers of a leaf's solid and its frame are data, and everything else
// is constant, as is what the module has besides these leaves. Where tracks go from one kind of
// leaf to another and back, as in a calorimeter, code for each leaf would cost more than it gains:
// the processor cannot predict which of them is called next.
namespace navjit::kernels {

/// Where the data of such a leaf begin; the leaf's own numbers follow.
struct SharedLeafData {
  const void* module;  ///< the data of all scenes of the module
};

/// The same as LeaveToScene, for such a leaf.
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
