#include "codegen/data/library_solids.hpp"

#include <cstring>
#include <type_traits>

#include "codegen/shapes.hpp"
#include "codegen/solids.hpp"
#include "codegen/typed_solid.hpp"

namespace navjit::codegen {
namespace {

using kernels::AnySolid;
using kernels::Intersection;
using kernels::SolidCode;
using kernels::Subtraction;
using kernels::Union;

using Box = kernels::Box<double>;
using Tube = kernels::Tube<double>;
using Trd = kernels::Trd<double>;
using Trap = kernels::Trap<double>;
using Sphere = kernels::Sphere<double>;
using Polyhedra = kernels::Polyhedra<double>;
using Polycone = kernels::Polycone<double>;
template <class Solid>
using Boxed = kernels::Boxed<double, Solid>;
template <class Solid>
using Moved = kernels::Placed<double, Solid>;
template <class Solid>
using Apart = kernels::SolidApart<Solid>;
using MovedTube = Boxed<Moved<Tube>>;
using TwoBoxes = Union<Moved<Box>, Moved<Box>>;

template <class... Solids>
struct List {};

/// A cut, a joint or a common part of plain solids, and what detectors that have nothing to do with
/// one another have in common (docs/experiments.md).
using Structures = List<
    // Two solids.
    Subtraction<Box, Box>,                     //
    Subtraction<Box, Moved<Box>>,              //
    Subtraction<Box, Boxed<Moved<Box>>>,       //
    Subtraction<Box, Boxed<Tube>>,             //
    Subtraction<Box, MovedTube>,               //
    Subtraction<Box, Boxed<Moved<Polycone>>>,  //
    Subtraction<Tube, Box>,                    //
    Subtraction<Tube, Moved<Box>>,             //
    Subtraction<Tube, Boxed<Moved<Box>>>,      //
    Subtraction<Tube, Boxed<Tube>>,            //
    Subtraction<Tube, MovedTube>,              //
    Subtraction<Trd, Boxed<Trd>>,              //
    Subtraction<Trap, Boxed<Trap>>,            //
    Subtraction<Polyhedra, Boxed<Polyhedra>>,  //
    Subtraction<Polycone, Boxed<Polycone>>,    //
    Subtraction<Sphere, Boxed<Tube>>,          //
    Subtraction<Sphere, MovedTube>,            //
    Union<Box, Box>,                           //
    Union<Box, Moved<Box>>,                    //
    Union<Box, Boxed<Moved<Box>>>,             //
    Union<Box, MovedTube>,                     //
    Union<Boxed<Tube>, Moved<Box>>,            //
    Union<Boxed<Tube>, MovedTube>,             //
    Union<Boxed<Trd>, Boxed<Moved<Trd>>>,      //
    Intersection<Box, Boxed<Moved<Box>>>,      //
    Intersection<Boxed<Tube>, Moved<Box>>,     //
    // Three.
    Subtraction<Box, Boxed<Union<Box, Box>>>,                 //
    Subtraction<Box, Boxed<TwoBoxes>>,                        //
    Subtraction<Box, Boxed<Union<Moved<Box>, MovedTube>>>,    //
    Subtraction<Box, Boxed<Union<Boxed<Tube>, Moved<Box>>>>,  //
    Subtraction<Box, Boxed<Union<MovedTube, MovedTube>>>,     //
    Subtraction<Box, Boxed<Subtraction<Box, MovedTube>>>,     //
    Subtraction<Tube, Boxed<Union<MovedTube, MovedTube>>>,    //
    Subtraction<Union<Box, Moved<Box>>, Moved<Box>>,          //
    Subtraction<Union<Box, Moved<Box>>, MovedTube>,           //
    Subtraction<Union<Box, MovedTube>, MovedTube>,            //
    Union<Box, Boxed<TwoBoxes>>,                              //
    Union<Moved<Box>, Boxed<Union<Box, Moved<Box>>>>,         //
    Union<Boxed<Subtraction<Box, Boxed<Moved<Box>>>>, Moved<Box>>,
    // Windows.
    Subtraction<Box, Boxed<Apart<Union<Moved<Box>, Boxed<TwoBoxes>>>>>,
    Subtraction<Box, Boxed<Apart<Union<Boxed<TwoBoxes>, Boxed<TwoBoxes>>>>>>;

/// A type of these as Shapes::type() has it.
template <class Solid>
struct NameOf;
#define NAVJIT_NAME(Shape)                                 \
  template <>                                              \
  struct NameOf<Shape> {                                   \
    static std::string get() { return #Shape "<double>"; } \
  };
NAVJIT_NAME(Box)
NAVJIT_NAME(Tube)
NAVJIT_NAME(Trd)
NAVJIT_NAME(Trap)
NAVJIT_NAME(Sphere)
NAVJIT_NAME(Polyhedra)
NAVJIT_NAME(Polycone)
#undef NAVJIT_NAME
#define NAVJIT_NAME(Boolean)                                                  \
  template <class A, class B>                                                 \
  struct NameOf<Boolean<A, B>> {                                              \
    static std::string get() {                                                \
      return #Boolean "<" + NameOf<A>::get() + ", " + NameOf<B>::get() + ">"; \
    }                                                                         \
  };
NAVJIT_NAME(Subtraction)
NAVJIT_NAME(Union)
NAVJIT_NAME(Intersection)
#undef NAVJIT_NAME
template <class Solid>
struct NameOf<Boxed<Solid>> {
  static std::string get() { return "Boxed<double, " + NameOf<Solid>::get() + ">"; }
};
template <class Solid>
struct NameOf<Apart<Solid>> {
  static std::string get() { return "SolidApart<" + NameOf<Solid>::get() + ">"; }
};
template <class Solid>
struct NameOf<Moved<Solid>> {
  static std::string get() { return "Placed<double, " + NameOf<Solid>::get() + ">"; }
};

/// More solids than any of the structures has.
constexpr std::size_t most_solids = 5;

/// A solid's code and numbers side by side: who calls one reads the other.
template <class Solid>
struct Numbered {
  SolidCode code;
  double tolerance;
  Solid solid;
};

template <class Solid>
bool contains_numbered(const void* data, const Vec3& p, const Direction& v) {
  const auto& s = *static_cast<const Numbered<Solid>*>(data);
  return contains(s.solid, p, v, s.tolerance);
}
template <class Solid>
double distance_to_in_numbered(const void* data, const Vec3& p, const Direction& v) {
  const auto& s = *static_cast<const Numbered<Solid>*>(data);
  return distance_to_in(s.solid, p, v, s.tolerance);
}
template <class Solid>
double distance_to_out_numbered(const void* data, const Vec3& p, const Direction& v) {
  const auto& s = *static_cast<const Numbered<Solid>*>(data);
  return distance_to_out(s.solid, p, v, s.tolerance);
}
template <class Solid>
double safety_to_in_numbered(const void* data, const Vec3& p) {
  return safety_to_in(static_cast<const Numbered<Solid>*>(data)->solid, p);
}
template <class Solid>
double safety_to_out_numbered(const void* data, const Vec3& p) {
  return safety_to_out(static_cast<const Numbered<Solid>*>(data)->solid, p);
}

template <class Solid>
const SolidCode* bind(const AnySolid<double>& solid, double tolerance, Arena& arena) {
  static_assert(std::is_trivially_copyable_v<Solid>);
  auto* bound = arena.array<Numbered<Solid>>(1);
  Arena passing;
  std::memcpy(&bound->solid, typed_shape(solid, passing), sizeof(Solid));
  bound->tolerance = tolerance;
  bound->code = {solid,
                 contains_numbered<Solid>,
                 distance_to_in_numbered<Solid>,
                 distance_to_out_numbered<Solid>,
                 safety_to_in_numbered<Solid>,
                 safety_to_out_numbered<Solid>,
                 bound};
  return &bound->code;
}

struct Structure {
  std::string type;
  const SolidCode* (*bind)(const AnySolid<double>& solid, double tolerance, Arena& arena);
};
template <class... Solids>
std::vector<Structure> all(List<Solids...>) {
  return {{NameOf<Solids>::get(), bind<Solids>}...};
}

const std::vector<Structure>& structures() {
  static const std::vector<Structure> made = all(Structures{});
  return made;
}

const Structure* find_structure(const AnySolid<double>& solid) {
  if (!gains_from_code(solid) || solids_in(solid) > most_solids) return nullptr;
  const std::string type = Shapes(true).type(solid);
  for (const Structure& structure : structures()) {
    if (structure.type == type) return &structure;
  }
  return nullptr;
}

}  // namespace

const SolidCode* library_code(const AnySolid<double>& solid, double tolerance, Arena& arena) {
  const Structure* structure = find_structure(solid);
  return structure == nullptr ? nullptr : structure->bind(solid, tolerance, arena);
}

bool is_in_library(const AnySolid<double>& solid) { return find_structure(solid) != nullptr; }

std::vector<std::string> library_structures() {
  std::vector<std::string> types;
  for (const Structure& structure : structures()) types.push_back(structure.type);
  return types;
}

}  // namespace navjit::codegen
