// physvol: one placement of a volume, of an assembly or of another file's volume.
#include <algorithm>
#include <cmath>

#include "geometry/gdml/structure.hpp"

namespace navjit::gdml {
namespace {

namespace fs = std::filesystem;

/// What a physvol places: an assembly, or else a volume.
struct Target {
  const Assembly* assembly = nullptr;
  VolumeId volume = 0;
  std::string name;
};

Target find_target(FileContext& file, const XmlElement& element, const std::string& name) {
  const auto assembly = file.assemblies.find(name);
  if (assembly != file.assemblies.end()) return {&assembly->second, 0, name};
  return {nullptr, file.look_up(&FileContext::volumes, element, "volume", name), name};
}

/// Geant4 looks in the working folder only. Since the command may be started in another folder,
/// names may also be relative to the file that has them, to the main file, or to a folder above
/// that: the top of a project that keeps its files in `geometry/` and starts Geant4 there.
fs::path module_path(FileContext& file, const XmlElement& element, std::string_view name) {
  const fs::path path(name);
  std::error_code error;
  if (fs::exists(path, error)) return path;
  const fs::path beside = fs::path(*element.file).parent_path() / path;
  if (fs::exists(beside, error)) return beside;
  const fs::path main_folder = fs::absolute(file.session.main_file, error).parent_path();
  for (fs::path folder = main_folder;; folder = folder.parent_path()) {
    const fs::path found = folder / path;
    if (fs::exists(found, error)) {
      if (folder != main_folder) {
        file.note(element, "found the file in a folder above the main file",
                  found.lexically_normal().string());
      }
      return found;
    }
    if (folder == folder.parent_path()) break;
  }
  fail(
      element,
      "there is no such file in the working folder, beside the file that names it, beside the main "
      "file, or in a folder above that; start in the folder from which the name counts");
}

/// <file name='...' volname='...'>: the module's volume of that name, or its world.
Target find_in_module(FileContext& file, const XmlElement& element) {
  const auto name = element.find("name");
  if (!name || name->empty()) fail(element, "attribute 'name' is missing; name a GDML file");
  if (name->find("://") != std::string_view::npos) {
    fail(element, "the module is on a network and is not fetched; save it beside the file");
  }
  FileContext& module = read_file(file.session, module_path(file, element, *name), &element);
  if (element.find("volname")) {
    return find_target(module, element, file.reference(element, "volname"));
  }
  const Setup& setup =
      at_element(element, [&]() -> const Setup& { return choose_setup(module, ""); });
  return find_target(module, *setup.world_element, setup.world);
}

/// -1 or 1 for every axis. As Geant4 does, it drops the size of a scale that does not reflect, and
/// refuses to reflect and stretch at once.
Vector signs(FileContext& file, const XmlElement& element, Vector scale) {
  bool stretches = false;
  for (double& s : scale) {
    if (s == 0) fail(element, "a scale of zero leaves nothing; give it another factor");
    stretches |= std::abs(std::abs(s) - 1) > 1e-9;
    s = s < 0 ? -1 : 1;
  }
  if (!stretches) return scale;
  if (scale[0] * scale[1] * scale[2] < 0) {
    fail(element, "unsupported scale that reflects and changes lengths; scale the solid instead");
  }
  file.note(element, "ignored a scale of a physvol that changes lengths, as Geant4 does");
  return scale;
}

/// `next`: the first daughter that has no number yet; so many daughters are before it.
void number_from(const Assembly& assembly, std::size_t base, std::span<Placement> daughters,
                 std::size_t& next) {
  const std::size_t before = base == 0 ? next : base;
  for (std::size_t i = 0; i < assembly.parts.size(); ++i) {
    if (const Assembly* nested = assembly.parts[i].nested) {
      number_from(*nested, 100 * i + base, daughters, next);
    } else {
      daughters[next++].copy_number = static_cast<int>(before + 1 + i);
    }
  }
}

}  // namespace

void number_imprint(const Assembly& assembly, std::span<Placement> daughters, std::size_t first) {
  number_from(assembly, 0, daughters, first);
}

// Geant4 places by translation * inverse rotation * scale, applied to daughter coordinates.
Transformation placement_frame(const Frame& frame, const Vector& scale) {
  double rotation[9];
  rotation_from_angles(frame.rotation[0], frame.rotation[1], frame.rotation[2], rotation);
  for (int i = 0; i < 9; ++i) rotation[i] *= scale[static_cast<std::size_t>(i / 3)];
  return make_transformation({frame.position[0], frame.position[1], frame.position[2]}, rotation);
}

/// No step depends on it, so that one which cannot be read is no reason to refuse the file.
int copy_number(FileContext& file, const XmlElement& element) {
  try {
    return file.integer(element, "copynumber", 0);
  } catch (const GdmlRefusal&) {
    throw;
  } catch (const GdmlError& e) {
    file.note(element, "its copynumber cannot be read: took 0", e);
    return 0;
  }
}

void read_physvol(FileContext& file, const XmlElement& element, Mother& mother) {
  std::optional<Target> target;
  Frame frame;
  Vector scale{1, 1, 1};
  for (const XmlElement& child : element.children()) {
    if (child.tag == "volumeref") {
      target = find_target(file, child, file.reference(child));
    } else if (child.tag == "file") {
      target = find_in_module(file, child);
    } else if (child.tag == "scale") {
      scale = signs(file, child, file.vector(child, Dimension::other, 1));
    } else if (child.tag == "scaleref") {
      scale = signs(file, child, file.look_up(file.scales, child, "scale", file.reference(child)));
    } else if (child.tag != "auxiliary" && !read_frame(file, child, "", frame)) {
      fail(child, "unknown element in a physvol; remove it");
    }
  }
  if (!target) fail(element, "it places no volume; add a <volumeref> or <file>");
  Placement placement;
  placement.auxiliaries = read_auxiliaries(file, element);
  placement.copy_number = copy_number(file, element);
  if (element.find("copynumber") && (mother.assembly != nullptr || target->assembly != nullptr)) {
    file.skip("gave no copynumber to what assemblies hold but that of Geant4");
  }
  placement.name = file.optional_name(element);
  if (placement.name.empty()) placement.name = target->name + "_PV";
  placement.transformation = placement_frame(frame, scale);
  if (target->assembly == nullptr) {
    placement.volume = target->volume;
    return add_placement(file, element, mother, std::move(placement));
  }
  mother.assembly_depth = std::max(mother.assembly_depth, 1 + target->assembly->depth);
  if (mother.assembly_depth > max_depth) {
    fail(element,
         "assemblies are nested more than " + std::to_string(max_depth) + " deep; flatten them");
  }
  check_placements(file, element, target->assembly->placements.size());
  const std::size_t first = mother.placements.size();
  const auto parts = mother.assembly == nullptr ? 0 : mother.assembly->parts.size();
  for (const Placement& inner : target->assembly->placements) {
    Placement imprint = inner;
    imprint.name = placement.name + '.' + inner.name;
    imprint.transformation = compose(placement.transformation, inner.transformation);
    add_placement(file, element, mother, std::move(imprint));
  }
  if (mother.assembly == nullptr)
    return number_imprint(*target->assembly, mother.placements, first);
  mother.assembly->parts.resize(parts);
  mother.assembly->parts.push_back({target->assembly});
}

}  // namespace navjit::gdml
