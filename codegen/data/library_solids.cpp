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
using Cone = kernels::Cone<double>;
using Trd = kernels::Trd<double>;
using Trap = kernels::Trap<double>;
using Hull = kernels::Hull<double>;
using Prism = kernels::Prism<double>;
using Orb = kernels::Orb<double>;
using Sphere = kernels::Sphere<double>;
using Polyhedra = kernels::Polyhedra<double>;
using Polycone = kernels::Polycone<double>;
using QuadricSolid = kernels::QuadricSolid<double>;
using Torus = kernels::Torus<double>;
using Arb8 = kernels::Arb8<double>;
template <class Solid>
using Boxed = kernels::Boxed<double, Solid>;
template <class Solid>
using Moved = kernels::Placed<double, Solid>;
template <class Solid>
using Apart = kernels::SolidApart<Solid>;
using MovedTube = Boxed<Moved<Tube>>;
/// A box that is turned as well as moved, and keeps the box around it (keeps_box()).
using TurnedBox = Boxed<Moved<Box>>;
using TwoBoxes = Union<Moved<Box>, Moved<Box>>;

template <class... Solids>
struct List {};
template <class... A, class... B>
List<A..., B...> operator+(List<A...>, List<B...>);
template <class... Lists>
using Joined = decltype((List<>{} + ... + Lists{}));

/// Solids that are not composed of others. Boxes are missing because they are asked without a call.
using Plain = List<Tube, Cone, Trd, Trap, Hull, Prism, Orb, Sphere, Polyhedra, Polycone,
                   QuadricSolid, Torus, Arb8>;
template <class Solid, class... Listed>
constexpr bool is_listed(List<Listed...>) {
  return (std::is_same_v<Solid, Listed> || ...);
}

// Most composed solids have holes that are boxes or tubes.

template <class Solid>
using OneHole =
    List<Subtraction<Solid, Box>, Subtraction<Solid, Moved<Box>>, Subtraction<Solid, TurnedBox>,
         Subtraction<Solid, Boxed<Tube>>, Subtraction<Solid, MovedTube>>;
template <class Solid, class Hole>
using HoleAndAnother = List<Subtraction<Solid, Boxed<Union<Hole, Box>>>,
                            Subtraction<Solid, Boxed<Union<Hole, Moved<Box>>>>,
                            Subtraction<Solid, Boxed<Union<Hole, TurnedBox>>>,
                            Subtraction<Solid, Boxed<Union<Hole, Boxed<Tube>>>>,
                            Subtraction<Solid, Boxed<Union<Hole, MovedTube>>>>;
template <class Solid>
using TwoHoles = Joined<HoleAndAnother<Solid, Box>, HoleAndAnother<Solid, Moved<Box>>,
                        HoleAndAnother<Solid, TurnedBox>, HoleAndAnother<Solid, Boxed<Tube>>,
                        HoleAndAnother<Solid, MovedTube>>;

/// These occur in the organs of phantoms and in phototubes.
using Ellipsoids =
    List<Subtraction<QuadricSolid, Boxed<QuadricSolid>>,
         Subtraction<QuadricSolid, Boxed<Moved<QuadricSolid>>>,
         Union<Boxed<QuadricSolid>, Boxed<Moved<QuadricSolid>>>,
         Union<Boxed<QuadricSolid>, MovedTube>, Union<Boxed<Tube>, Boxed<Moved<QuadricSolid>>>>;

/// Structures that occur in several unrelated detectors (docs/experiments.md).
using Others = List<
    // Two solids.
    Subtraction<Box, Boxed<Moved<Polycone>>>,  //
    Subtraction<Trd, Boxed<Trd>>,              //
    Subtraction<Trap, Boxed<Trap>>,            //
    Subtraction<Hull, Boxed<Moved<Hull>>>,     //
    Subtraction<Polyhedra, Boxed<Polyhedra>>,  //
    Subtraction<Polycone, Boxed<Polycone>>,    //
    Subtraction<Sphere, Boxed<Tube>>,          //
    Subtraction<Sphere, MovedTube>,            //
    Union<Box, Box>,                           //
    Union<Box, Moved<Box>>,                    //
    TwoBoxes,                                  //
    Union<Box, TurnedBox>,                     //
    Union<Box, MovedTube>,                     //
    Union<Box, Boxed<Moved<Hull>>>,            //
    Union<Boxed<Tube>, Moved<Box>>,            //
    Union<Boxed<Tube>, MovedTube>,             //
    Union<Boxed<Trd>, Boxed<Moved<Trd>>>,      //
    Intersection<Box, TurnedBox>,              //
    Intersection<Boxed<Tube>, Box>,            //
    Intersection<Boxed<Tube>, Moved<Box>>,     //
    Intersection<Boxed<Hull>, TurnedBox>,      //
    Intersection<Boxed<Hull>, MovedTube>,      //
    // Three.
    Subtraction<Box, Boxed<Union<Box, Boxed<Moved<Trd>>>>>,            //
    Subtraction<Box, Boxed<Subtraction<Box, MovedTube>>>,              //
    Subtraction<Hull, Boxed<Union<Boxed<Hull>, Boxed<Hull>>>>,         //
    Subtraction<Union<Box, Moved<Box>>, Moved<Box>>,                   //
    Subtraction<Union<Box, Moved<Box>>, MovedTube>,                    //
    Subtraction<Union<Box, MovedTube>, MovedTube>,                     //
    Union<Box, Boxed<TwoBoxes>>,                                       //
    Union<Moved<Box>, Boxed<TwoBoxes>>,                                //
    Subtraction<Prism, Boxed<TwoBoxes>>,                               //
    Subtraction<Hull, Boxed<TwoBoxes>>,                                //
    Union<Moved<Box>, Boxed<Union<Box, Moved<Box>>>>,                  //
    Union<Moved<Box>, Boxed<Union<Boxed<Tube>, Moved<Box>>>>,          //
    Union<TurnedBox, Boxed<Union<Boxed<Tube>, TurnedBox>>>,            //
    Union<Boxed<Moved<Trap>>, Boxed<Union<Box, Boxed<Moved<Trap>>>>>,  //
    Union<MovedTube, Boxed<Union<Boxed<Tube>, MovedTube>>>,            //
    Union<MovedTube, Boxed<Union<Boxed<Moved<Hull>>, Boxed<Tube>>>>,   //
    Union<MovedTube, Boxed<Union<Boxed<Moved<Prism>>, Boxed<Tube>>>>,  //
    Union<Boxed<Subtraction<Box, TurnedBox>>, Moved<Box>>,             //
    // Windows.
    Subtraction<Box, Boxed<Apart<Union<Moved<Box>, Boxed<TwoBoxes>>>>>,
    Subtraction<Box, Boxed<Apart<Union<Boxed<TwoBoxes>, Boxed<TwoBoxes>>>>>>;

using Structures = Joined<OneHole<Box>, OneHole<Tube>, OneHole<Cone>, OneHole<Trd>, OneHole<Trap>,
                          OneHole<Hull>, OneHole<Prism>, OneHole<Polycone>, OneHole<QuadricSolid>,
                          TwoHoles<Box>, TwoHoles<Tube>, Ellipsoids, Others>;

/// The name of one of these types, as Shapes::type() spells it.
template <class Solid>
struct NameOf;
#define NAVJIT_NAME(Shape)                                 \
  template <>                                              \
  struct NameOf<Shape> {                                   \
    static std::string get() { return #Shape "<double>"; } \
  };
NAVJIT_NAME(Box)
NAVJIT_NAME(Tube)
NAVJIT_NAME(Cone)
NAVJIT_NAME(Trd)
NAVJIT_NAME(Trap)
NAVJIT_NAME(Hull)
NAVJIT_NAME(Prism)
NAVJIT_NAME(Sphere)
NAVJIT_NAME(Polyhedra)
NAVJIT_NAME(Polycone)
NAVJIT_NAME(QuadricSolid)
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

/// The largest number of solids that one of the structures is composed of.
constexpr std::size_t most_solids = 5;

/// A solid's code and its numbers side by side, because a caller of the code also reads the
/// numbers.
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
  // AnySolid has composed solids in another form than these types.
  const bool is_plain = !is_composed(solid.kind);
  bound->code = {{solid.kind, is_plain ? &bound->solid : solid.shape},
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

const SolidCode* plain_code(const AnySolid<double>& solid, double tolerance, Arena& arena) {
  return kernels::visit(solid, [&](const auto& shape) -> const SolidCode* {
    using Shape = std::decay_t<decltype(shape)>;
    if constexpr (is_listed<Shape>(Plain{})) {
      return bind<Shape>(solid, tolerance, arena);
    } else {
      return nullptr;
    }
  });
}

bool is_in_library(const AnySolid<double>& solid) { return find_structure(solid) != nullptr; }

std::vector<std::string> library_structures() {
  std::vector<std::string> types;
  for (const Structure& structure : structures()) types.push_back(structure.type);
  return types;
}

}  // namespace navjit::codegen
