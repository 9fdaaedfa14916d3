// Reads a GDML file from its root: sections, setups and modules.
#include "geometry/gdml/read_world.hpp"

#include <algorithm>

#include "geometry/gdml/structure.hpp"

namespace navjit {
namespace gdml {
namespace {

namespace fs = std::filesystem;

constexpr int max_open_files = 32;

void read_setup(FileContext& file, const XmlElement& setup) {
  for (const XmlElement& child : setup.children()) {
    if (child.tag != "world") continue;
    file.setups.push_back({file.optional_name(setup), file.reference(child), &child});
  }
}

/// The tags of the main file count, those of modules do not.
void read_userinfo(FileContext& file, const XmlElement& element) {
  if (&file != file.session.files_in_order.front())
    return file.skip("skipped <userinfo> of a module");
  file.session.world.auxiliaries = read_auxiliaries(file, element);
}
void skip_extension(FileContext& file, const XmlElement&) { file.skip("skipped <extension>"); }

constexpr struct {
  std::string_view tag;
  ElementReader read;
} sections[] = {
    {"define", read_define},       {"materials", read_materials}, {"solids", read_solids},
    {"structure", read_structure}, {"setup", read_setup},         {"userinfo", read_userinfo},
    {"extension", skip_extension},
};

void read_root(FileContext& file) {
  const XmlElement& root = *file.document->root;
  if (!root.tag.starts_with("gdml")) {
    fail(root, "this is not a GDML file; its root element must be <gdml>");
  }
  for (const XmlElement& element : root.children()) {
    const auto* section = std::find_if(std::begin(sections), std::end(sections),
                                       [&](const auto& s) { return s.tag == element.tag; });
    if (section == std::end(sections)) {
      file.note(element, "left out a section of an unknown kind");
      continue;
    }
    at_element(element, [&] { section->read(file, element); });
  }
}

std::string canonical_name(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  return error ? path.string() : canonical.string();
}

}  // namespace

FileContext& read_file(Session& session, const fs::path& path, const XmlElement* from) {
  auto& file = session.files[canonical_name(path)];
  if (file != nullptr) {
    if (!file->problem.empty()) fail_needing(*from, file->problem);
    if (!file->complete) {
      refuse(*from,
             "file '" + printable_path(path.string()) + "' includes itself; remove the cycle");
    }
    return *file;
  }
  if (++session.open_files > max_open_files) {
    refuse(*from, "modules are nested more than " + std::to_string(max_open_files) +
                      " deep; name them in one file");
  }
  file = std::make_unique<FileContext>(session);
  session.files_in_order.push_back(file.get());
  try {
    file->document = parse_xml(path, session.options.limits, session.xml, from);
    if (file->document->ends_in_junk) {
      file->note(*file->document->root, "left out what stands behind its end");
    }
    read_root(*file);
  } catch (const GdmlError& e) {
    file->problem = e.what();
    --session.open_files;
    throw;
  }
  file->complete = true;
  --session.open_files;
  return *file;
}

const Setup& choose_setup(const FileContext& file, const std::string& wanted) {
  const XmlElement& root = *file.document->root;
  if (file.setups.empty()) fail(root, "it has no <setup> with a <world>; add one");
  const auto named = [&](const std::string& name) {
    return std::find_if(file.setups.begin(), file.setups.end(),
                        [&](const Setup& s) { return s.name == name; });
  };
  const auto setup = named(wanted.empty() ? "Default" : wanted);
  if (setup != file.setups.end()) return *setup;
  if (wanted.empty()) return file.setups.front();
  std::string known;
  for (const Setup& s : file.setups)
    known += (known.empty() ? "'" : ", '") + printable(s.name) + "'";
  fail(root, "setup '" + printable(wanted) + "' is not defined; choose one of " + known);
}

}  // namespace gdml

namespace {

World read_unchecked(const std::filesystem::path& path, const GdmlOptions& options,
                     GdmlReport* report) {
  gdml::Session session(options);
  session.main_file = path;
  gdml::FileContext& file = gdml::read_file(session, path, nullptr);
  const gdml::Setup& setup = gdml::choose_setup(file, options.setup);
  const gdml::XmlElement& world_element = *setup.world_element;
  World& world = session.world;
  world.top = file.assemblies.contains(setup.world)
                  ? gdml::box_around(file, world_element, setup.world)
                  : file.look_up(&gdml::FileContext::volumes, world_element, "volume", setup.world);
  gdml::at_element(world_element, [&] { finish(world); });
  if (world.volumes[world.top].touchables > options.limits.max_touchables) {
    gdml::fail(world_element, "the world has " +
                                  std::to_string(world.volumes[world.top].touchables) +
                                  " touchables; raise GdmlLimits::max_touchables if this is meant");
  }
  if (report != nullptr) session.notes.tell(*report);
  return std::move(world);
}

}  // namespace

World read_world(const std::filesystem::path& path, const GdmlOptions& options,
                 GdmlReport* report) {
  try {
    return read_unchecked(path, options, report);
  } catch (const GdmlError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw GdmlError(printable_path(path.string()) + ":0: " + printable(e.what()));
  }
}

Detector read_gdml(const std::filesystem::path& path, const GdmlOptions& options,
                   GdmlReport* report) {
  return Detector(read_world(path, options, report));
}

}  // namespace navjit
