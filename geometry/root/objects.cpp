#include "geometry/root/objects.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "geometry/root/lists.hpp"
#include "geometry/root/names.hpp"
#include "geometry/root/numbers.hpp"

namespace navjit::root {
namespace {

/// The members that detectors are made of; all others are skipped.
constexpr auto wanted_members =
    std::to_array<std::string_view>({"fA",        "fAbundances",  "fAlpha",
                                     "fAlpha1",   "fAlpha2",      "fAmixture",
                                     "fBl1",      "fBl2",         "fDX",
                                     "fDY",       "fDZ",          "fDensity",
                                     "fDphi",     "fDx",          "fDx1",
                                     "fDx2",      "fDy",          "fDy1",
                                     "fDy2",      "fDz",          "fElement",
                                     "fElements", "fFinder",      "fH1",
                                     "fH2",       "fIndex",       "fIsotopes",
                                     "fLeft",     "fLeftMat",     "fMasterVolume",
                                     "fMaterial", "fMatrix",      "fMedium",
                                     "fN",        "fNedges",      "fNelements",
                                     "fNhigh",    "fNisotopes",   "fNlow",
                                     "fNode",     "fNodes",       "fNumber",
                                     "fNvert",    "fNz",          "fOrigin",
                                     "fP",        "fPhi",         "fPhi1",
                                     "fPhi2",     "fR",           "fRadLen",
                                     "fRhi",      "fRight",       "fRightMat",
                                     "fRlo",      "fRmax",        "fRmax1",
                                     "fRmax2",    "fRmin",        "fRmin1",
                                     "fRmin2",    "fRotation",    "fRotationMatrix",
                                     "fScale",    "fShape",       "fStIn",
                                     "fStOut",    "fStart",       "fState",
                                     "fStep",     "fTemperature", "fTheta",
                                     "fTheta1",   "fTheta2",      "fTl1",
                                     "fTl2",      "fTranslation", "fTwistAngle",
                                     "fVolume",   "fWeights",     "fX",
                                     "fX0",       "fXY",          "fY",
                                     "fY0",       "fZ",           "fZmixture"});

std::optional<std::string_view> wanted(std::string_view name) {
  const auto* const found = std::lower_bound(wanted_members.begin(), wanted_members.end(), name);
  if (found == wanted_members.end() || *found != name) return std::nullopt;
  return *found;
}

std::vector<double> numbers_at(Bytes& at, std::uint32_t type, std::size_t count) {
  std::vector<double> all(count);
  for (double& number : all) number = number_at(at, type);
  return all;
}

bool is_vector_read(std::string_view name) { return name == "fVertices" || name == "fFacets"; }

bool is_pointer(std::uint32_t type) { return type == pointer || type == pointer_any; }

/// Skips an object that has its length before it; false if it has none.
bool skip_object(Bytes& at) {
  const VersionHeader header = version_header(at);
  if (header.end == 0) return false;
  at = Bytes(at.all(), header.end);
  return true;
}

}  // namespace

Objects::Objects(std::string bytes, const Key& key, const Layouts& layouts)
    : bytes_(std::move(bytes)),
      record_{bytes_, key.key_bytes},
      own_type_(key.type),
      layouts_(layouts),
      // In ordinary files each byte is a part of few objects; a hostile file could exceed this.
      budget_(4 * bytes_.size() + 100'000) {}

void Objects::spend(std::size_t amount) {
  if (amount > budget_) throw FormatError("its objects are within one another; it is damaged");
  budget_ -= amount;
}

const Object& Objects::at(Reference reference) {
  auto& known = known_[reference];
  if (!known) known = std::make_unique<const Object>(read(reference));
  return *known;
}

std::vector<Reference> Objects::list(Reference reference) {
  if (reference == 0) return {};
  const Located found = record_.locate(reference);
  return list_at(record_, found.type, Bytes(record_.bytes.substr(0, found.end), found.begin),
                 [&](std::size_t count) { spend(4 * count); });
}

Object Objects::read(Reference reference) {
  if (reference == 0) throw FormatError("a pointer to nothing is followed");
  const Located found = reference == own_object ? Located{own_type_, 0, record_.bytes.size()}
                                                : record_.locate(reference);
  Object object{.type = std::string(found.type)};
  spend(found.type.size());
  Bytes at(record_.bytes.substr(0, found.end), found.begin);
  Counters counters;
  read_class(at, found.type, object, counters, 0);
  return object;
}

void Objects::read_class(Bytes& at, std::string_view type, Object& into, Counters& counters,
                         int depth) {
  constexpr int most_bases = 32;
  if (depth > most_bases) throw FormatError("class " + into.type + " has too many bases");
  const VersionHeader header = version_header(at);
  const Layout* layout = layouts_.find(type, header.version);
  Bytes in(header.end == 0 ? at.all() : at.all().substr(0, header.end), at.at());
  const auto finish = [&] { at = header.end == 0 ? in : Bytes(at.all(), header.end); };
  if (layout == nullptr) {
    if (depth == 0) into.fail("the file does not describe its class");
    return finish();
  }
  for (const Member& member : *layout) {
    spend(1);
    if (member.type == base) {
      read_class(in, member.name, into, counters, depth + 1);
    } else if (member.type == 6) {
      Bytes ahead = in;
      counters.emplace_back(member.name, ahead.u32());
      read_member(in, member, counters, into);
    } else if (!read_member(in, member, counters, into)) {
      break;  // what follows cannot be located
    }
  }
  finish();
}

bool Objects::read_member(Bytes& at, const Member& member, const Counters& counters, Object& into) {
  const std::optional<std::string_view> keep = wanted(member.name);
  const std::uint32_t type = member.type;
  if (type == root_object) {
    const std::uint32_t bits = object_bits(at);
    if (member.name == "TObject") into.bits = bits;
    return true;
  }
  if (type == named) {
    const VersionHeader header = version_header(at);
    const std::uint32_t bits = object_bits(at);
    const std::string_view name = at.text();
    at.text();  // title
    if (member.name == "TNamed") {
      spend(name.size());
      into.bits = bits;
      into.name = readable(name);
    }
    if (header.end != 0) at = Bytes(at.all(), header.end);
    return true;
  }
  if (type == text) {
    const std::string_view value = at.text();
    // Where TNamed is no base, it stands here by its own layout.
    if (member.name == "fName") {
      spend(value.size());
      into.name = readable(value);
    }
    return true;
  }
  if (is_pointer(type)) {
    const Reference reference = record_.pointer(at);
    if (keep) into.members.emplace_back(*keep, reference);
    return true;
  }
  if (type > counted_end && is_pointer(type - basic_end)) {
    if (member.length > at.left() / 4) return false;
    spend(member.length);
    for (std::uint32_t i = 0; i < member.length; ++i) record_.pointer(at);
    return true;
  }
  if (const std::size_t size = number_size(type); size > 0) {
    if (!keep) {
      at.skip(size);
    } else {
      into.members.emplace_back(*keep, number_at(at, type));
    }
    return true;
  }
  if (type == text_pointer) {
    at.skip(at.u32());
    return true;
  }
  if (type > basic_end && type < counted_end) {
    const bool variable = type > counted;
    const std::uint32_t of = type - (variable ? counted : basic_end);
    const std::size_t size = number_size(of);
    std::size_t count = member.length;
    if (variable) {
      if (at.u8() == 0) return true;  // no array was written
      const auto counter = std::find_if(counters.begin(), counters.end(),
                                        [&](const auto& c) { return c.first == member.counter; });
      if (counter == counters.end()) return false;
      count = counter->second;
    }
    if (size == 0 || count > at.left() / size) return false;
    if (!keep) {
      at.skip(size * count);
    } else {
      spend(count * size);
      into.members.emplace_back(*keep, numbers_at(at, of, count));
    }
    return true;
  }
  if (type == basic_end + text) {
    for (std::uint32_t i = 0; i < member.length; ++i) at.text();
    return true;
  }
  if (!member.content.empty() && is_vector_read(member.name)) return read_vector(at, member, into);
  // Objects in place, containers of the standard library, and classes that write themselves.
  const bool several = type == basic_end + embedded || type == basic_end + embedded_any;
  for (std::uint32_t i = 0; i < (several ? member.length : 1); ++i) {
    if (!skip_object(at)) return false;
  }
  return true;
}

}  // namespace navjit::root
