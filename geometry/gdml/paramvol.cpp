// paramvol: placements of one volume, each with its own frame and dimensions.
#include "geometry/gdml/structure.hpp"

namespace navjit::gdml {
namespace {

/// A paramvol that is being read.
struct Parameterised {
  FileContext& file;
  Mother& mother;
  VolumeId volume = 0;
  std::string_view kind{};  ///< the tag of the volume's solid
  std::string name{};       ///< the name of the placements, without their number
  int copies = 0;
  /// The dimensions that were given last, and the volume that has them: often they change rarely.
  std::optional<DivisibleShape> last_shape{};
  VolumeId last = 0;
};

constexpr std::string_view suffix = "_dimensions";

VolumeId volume_of(Parameterised& all, const XmlElement& dimensions) {
  FileContext& file = all.file;
  const std::string_view kind = dimensions.tag.substr(0, dimensions.tag.size() - suffix.size());
  if (kind != all.kind) {
    fail(dimensions, "these are not dimensions of the volume's solid, a '" + printable(all.kind) +
                         "'; use <" + printable(all.kind) + "_dimensions>");
  }
  const std::string name = file.session.world.volumes[all.volume].solid.name;
  NamedSolid made = read_dimensions(file, dimensions, kind, name);
  if (made.shape && all.last_shape == made.shape) return all.last;
  all.last = with_solid(file, dimensions, all.volume, std::move(*made.solid),
                        made.shape ? size_of(*made.shape) : 0);
  all.last_shape = std::move(made.shape);
  return all.last;
}

void read_parameters(Parameterised& all, const XmlElement& element) {
  FileContext& file = all.file;
  Frame frame;
  Placement copy;
  copy.volume = all.volume;
  for (const XmlElement& child : element.children()) {
    if (child.tag.ends_with(suffix)) {
      copy.volume = volume_of(all, child);
    } else if (child.tag == "auxiliary") {
      file.skip("skipped <auxiliary> in <parameters>");
    } else if (!read_frame(file, child, "", frame)) {
      fail(child, "unknown element in parameters; use position, rotation or dimensions");
    }
  }
  // The order of the copies counts, not the number that they give, as in Geant4.
  copy.copy_number = all.copies;
  copy.name = all.name + '_' + std::to_string(all.copies++);
  copy.transformation = at_element(element, [&] { return placement_frame(frame); });
  add_placement(file, element, all.mother, std::move(copy));
}

void read_contents(Parameterised& all, const XmlElement& element) {
  for (const XmlElement& child : element.children()) {
    all.file.charge(child);
    if (child.tag == "parameters") {
      read_parameters(all, child);
    } else if (child.tag == "parameterised_position_size") {
      read_contents(all, child);
    } else if (child.tag == "loop") {
      all.file.loop(child, [&] { read_contents(all, child); });
    } else if (child.tag == "auxiliary") {
      all.file.skip("skipped <auxiliary> in <paramvol>");
    } else if (child.tag != "volumeref") {
      fail(child,
           "unknown element in a paramvol; use parameterised_position_size, parameters or "
           "loop");
    }
  }
}

}  // namespace

void read_paramvol(FileContext& file, const XmlElement& element, Mother& mother) {
  Parameterised all{.file = file, .mother = mother};
  const XmlElement* reference = nullptr;
  for (const XmlElement& child : element.children()) {
    if (child.tag == "volumeref") reference = &child;
  }
  if (reference == nullptr) fail(element, "it has no <volumeref>; add one");
  all.volume =
      file.look_up(&FileContext::volumes, *reference, "volume", file.reference(*reference));
  const NamedSolid* solid = file.session.volume_solids[all.volume];
  if (solid != nullptr && solid->element != nullptr) all.kind = solid->element->tag;
  all.name = file.optional_name(element);
  if (all.name.empty()) all.name = file.session.world.volumes[all.volume].name + "_param";
  read_contents(all, element);
  if (all.copies == 0) fail(element, "it has no <parameters>; add some");
}

}  // namespace navjit::gdml
