#include "geometry/gdml/xml.hpp"

#include <expat.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <vector>

#include "geometry/gdml/entities.hpp"
#include "geometry/gdml/gzip.hpp"
#include "geometry/input_file.hpp"

namespace navjit::gdml {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_entity_nesting = 32;
constexpr std::size_t max_entity_chain = 1000;

struct ParserDeleter {
  void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};
using ParserPtr = std::unique_ptr<std::remove_pointer_t<XML_Parser>, ParserDeleter>;

/// One character of UTF-8 of two to four bytes, for expat; -1 where it is none. Expat takes no
/// characters beyond the first 65536 from here: they all become U+FFFD.
int XMLCALL utf8_character(void*, const char* bytes) {
  const auto byte = [&](int i) { return static_cast<unsigned char>(bytes[i]); };
  const int more = byte(0) >= 0xF0 ? 3 : byte(0) >= 0xE0 ? 2 : 1;
  int code = byte(0) & (0x3F >> more);
  for (int i = 1; i <= more; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return -1;
    code = code << 6 | (byte(i) & 0x3F);
  }
  constexpr int least[] = {0, 0x80, 0x800, 0x10000};
  if (code < least[more] || (code >= 0xD800 && code < 0xE000) || code > 0x10FFFF) return -1;
  return code > 0xFFFF ? 0xFFFD : code;
}

/// How many bytes of UTF-8 begin with this one, as expat wants it told.
int utf8_length(int byte) {
  if (byte < 0x80) return byte;
  if (byte < 0xC2 || byte > 0xF4) return -1;
  return byte < 0xE0 ? -2 : byte < 0xF0 ? -3 : -4;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = (c >= 'A' && c <= 'Z') ? static_cast<char>(c + 32) : c;
  return lower;
}

/// Expat knows UTF-8, UTF-16, ISO-8859-1 and US-ASCII by these names alone; files have others for
/// them. For other encodings only their ASCII part matters: markup and numbers are in ASCII, and in
/// names other bytes need only stay distinct. The encoding that nobody knows is kept in `unknown`.
int XMLCALL on_unknown_encoding(void* unknown, const XML_Char* name, XML_Encoding* encoding) {
  const std::string lower = lower_case(name);
  const auto is = [&](auto... names) { return ((lower == names) || ...); };
  const auto begins = [&](auto... starts) { return (lower.starts_with(starts) || ...); };
  const bool utf8 = is("utf8", "utf_8");
  const bool ascii = is("ascii", "iso646-us", "ansi_x3.4-1968", "us_ascii");
  const bool bytes = is("l1", "latin1", "latin-1", "latin_1", "ibm819", "cp819") ||
                     begins("iso-8859-", "iso8859-", "iso_8859-", "windows-125", "cp125");
  if (!utf8 && !ascii && !bytes) {
    *static_cast<std::string*>(unknown) = lower.substr(0, 40);
    return XML_STATUS_ERROR;
  }
  for (int i = 0; i < 256; ++i) {
    encoding->map[i] = utf8 ? utf8_length(i) : ascii && i > 127 ? -1 : i;
  }
  encoding->data = nullptr;
  encoding->convert = utf8 ? utf8_character : nullptr;
  encoding->release = nullptr;
  return XML_STATUS_OK;
}

/// Where <auxiliary> may stand. Anywhere else nothing reads it, and it would disturb the readers
/// that know all children that an element may have.
bool may_have_tags(std::string_view tag) {
  constexpr std::string_view tags[] = {
      "volume",    "physvol", "userinfo", "auxiliary", "assembly", "structure",  "define",
      "materials", "solids",  "loop",     "paramvol",  "gdml",     "parameters", "extension"};
  return std::find(std::begin(tags), std::end(tags), tag) != std::end(tags);
}

/// "%20" is a blank, and so on: system identifiers are URIs.
std::string percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    const char* const digits = text.data() + i + 1;
    if (text[i] == '%' && text.size() - i > 2 &&
        std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2 && value != 0) {
      decoded += static_cast<char>(value);
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

/// Builds the tree from expat's callbacks. They are called from C, so no exception may leave them:
/// the first problem is kept and the parsers are stopped.
class Builder {
 public:
  Builder(XmlDocument& document, const GdmlLimits& limits, XmlBudget& budget)
      : document_(document), limits_(limits), budget_(budget) {}

  void parse_document(const fs::path& path, const XmlElement* from);

 private:
  struct Source {
    XML_Parser parser;
    const std::string* file;
  };
  struct Open {
    XmlElement* element;
    XmlElement* last_child;
  };

  static void XMLCALL on_start(void* self, const XML_Char* tag, const XML_Char** attributes);
  static void XMLCALL on_end(void* self, const XML_Char* tag);
  static void XMLCALL on_text(void* self, const XML_Char* text, int length);
  static void XMLCALL on_entity(void* self, const XML_Char* name, int, const XML_Char*, int,
                                const XML_Char*, const XML_Char*, const XML_Char*, const XML_Char*);
  static void XMLCALL on_skipped_entity(void* self, const XML_Char* name, int);
  static int XMLCALL on_external_entity(XML_Parser parser, const XML_Char* context,
                                        const XML_Char* base, const XML_Char* system_id,
                                        const XML_Char*);

  template <class F>
  void guarded(F&& f);
  void start(const XML_Char* tag, const XML_Char** attributes);
  void check_entities();
  void fail_undeclared(std::string_view name);
  void external_entity(const XML_Char* context, const char* base, const char* system_id);
  void parse_text(XML_Parser parser, const std::string& file, const std::string& text);
  Expected<std::string> read_file(const fs::path& path);
  std::string_view keep(std::string_view text);
  void stop(const std::string& message);
  std::string here() const;

  XmlDocument& document_;
  const GdmlLimits& limits_;
  XmlBudget& budget_;
  std::vector<Source> sources_;
  std::vector<Open> open_;
  std::string text_;
  std::size_t entities_ = 0, parameter_entities_ = 0;
  std::string unread_;  ///< declarations that could not be read, and why; empty if all were
  EntityReferences references_;
  std::string unknown_encoding_;  ///< what the file says of itself, where nobody knows it
  std::string problem_;
  bool out_of_memory_ = false;
};

template <class F>
void Builder::guarded(F&& f) {
  if (!problem_.empty() || out_of_memory_) return;
  try {
    f();
  } catch (const std::bad_alloc&) {
    out_of_memory_ = true;
    XML_StopParser(sources_.back().parser, XML_FALSE);
  } catch (const std::exception& e) {
    stop(here() + e.what());
  }
}

void Builder::stop(const std::string& message) {
  if (problem_.empty()) problem_ = message;
  XML_StopParser(sources_.back().parser, XML_FALSE);
}

std::string Builder::here() const {
  const Source& source = sources_.back();
  std::string where = printable_path(*source.file) + ':' +
                      std::to_string(XML_GetCurrentLineNumber(source.parser)) + ": ";
  if (!open_.empty()) where += "in " + label(*open_.back().element) + ": ";
  return where;
}

std::string_view Builder::keep(std::string_view text) {
  if (text.empty()) return {};
  char* copy = static_cast<char*>(document_.arena.allocate(text.size(), 1));
  std::memcpy(copy, text.data(), text.size());
  return {copy, text.size()};
}

void Builder::on_start(void* self, const XML_Char* tag, const XML_Char** attributes) {
  auto* builder = static_cast<Builder*>(self);
  builder->guarded([&] { builder->start(tag, attributes); });
}

/// Where declarations are missing, expat silently replaces an unknown entity in an attribute by
/// nothing; therefore the text of the tag is searched for entities.
void Builder::check_entities() {
  int offset = 0, size = 0;
  XML_Parser parser = sources_.back().parser;
  const char* text = XML_GetInputContext(parser, &offset, &size);
  const int length = XML_GetCurrentByteCount(parser);
  if (text == nullptr || offset < 0 || length < 0 || length > size - offset) return;
  std::string_view rest(text + offset, static_cast<std::size_t>(length));
  for (std::size_t begin; (begin = rest.find('&')) != std::string_view::npos;) {
    rest.remove_prefix(begin + 1);
    const std::string_view name = rest.substr(0, rest.find(';'));
    constexpr std::string_view own[] = {"amp", "lt", "gt", "quot", "apos"};
    if (name.starts_with('#') || references_.is_declared(name)) continue;
    if (std::find(std::begin(own), std::end(own), name) == std::end(own)) {
      return fail_undeclared(name);
    }
  }
}

void Builder::start(const XML_Char* tag, const XML_Char** attributes) {
  if (!unread_.empty()) check_entities();
  if (!problem_.empty()) return;
  if (budget_.elements == 0) {
    return stop(here() + "too many XML elements; raise GdmlLimits::max_elements if this is meant");
  }
  if (open_.size() >= limits_.max_depth) {
    return stop(here() + "XML elements are nested more than " + std::to_string(limits_.max_depth) +
                " deep; raise GdmlLimits::max_depth if this is meant");
  }
  --budget_.elements;
  std::pmr::polymorphic_allocator<> allocator(&document_.arena);
  auto* element = allocator.new_object<XmlElement>();
  element->tag = keep(tag);
  element->file = sources_.back().file;
  element->line = XML_GetCurrentLineNumber(sources_.back().parser);
  std::size_t count = 0;
  while (attributes[2 * count] != nullptr) ++count;
  auto* kept = allocator.allocate_object<XmlAttribute>(count);
  for (std::size_t i = 0; i < count; ++i) {
    kept[i] = {keep(attributes[2 * i]), keep(attributes[2 * i + 1])};
  }
  element->attributes = kept;
  element->attribute_count = count;
  if (open_.empty()) {
    document_.root = element;
  } else if (element->tag == "auxiliary" && !may_have_tags(open_.back().element->tag)) {
    // It stays out of the tree.
  } else {
    Open& mother = open_.back();
    if (mother.last_child != nullptr) {
      mother.last_child->next_sibling = element;
    } else {
      mother.element->first_child = element;
    }
    mother.last_child = element;
  }
  open_.push_back({element, nullptr});
  text_.clear();
}

void Builder::on_end(void* self, const XML_Char*) {
  auto* builder = static_cast<Builder*>(self);
  builder->guarded([&] {
    XmlElement* element = builder->open_.back().element;
    if (element->tag == "expression") element->text = builder->keep(builder->text_);
    builder->open_.pop_back();
    builder->text_.clear();
  });
}

void Builder::on_text(void* self, const XML_Char* text, int length) {
  auto* builder = static_cast<Builder*>(self);
  builder->guarded([&] {
    if (!builder->open_.empty() && builder->open_.back().element->tag == "expression") {
      builder->text_.append(text, static_cast<std::size_t>(length));
    }
  });
}

// Expat bounds the length of expanded entities, but it follows a chain of them by recursion.
void Builder::on_entity(void* self, const XML_Char* name, int is_parameter, const XML_Char* value,
                        int length, const XML_Char*, const XML_Char*, const XML_Char*,
                        const XML_Char*) {
  auto* builder = static_cast<Builder*>(self);
  builder->guarded([&] {
    if (++builder->entities_ > builder->limits_.max_entities) {
      builder->stop(builder->here() + "more than " + std::to_string(builder->limits_.max_entities) +
                    " entities are declared; raise GdmlLimits::max_entities if this is meant");
    } else if (is_parameter != 0 && ++builder->parameter_entities_ > max_entity_chain) {
      builder->stop(builder->here() + "more than " + std::to_string(max_entity_chain) +
                    " parameter entities are declared; write out what they mean");
    } else if (is_parameter == 0 && value != nullptr &&
               !builder->references_.declare(name, {value, static_cast<std::size_t>(length)},
                                             max_entity_chain)) {
      builder->stop(builder->here() + "more than " + std::to_string(max_entity_chain) +
                    " entities refer to one another in a chain; write out what they mean");
    }
  });
}

void Builder::fail_undeclared(std::string_view name) {
  stop(here() + "entity '&" + printable(name) + ";' is not declared" +
       (unread_.empty() ? "; declare it in the file's DOCTYPE"
                        : ", or where it could not be read: " + unread_));
}

void Builder::on_skipped_entity(void* self, const XML_Char* name, int is_parameter) {
  auto* builder = static_cast<Builder*>(self);
  if (is_parameter != 0) return;  // what it would have declared is reported where it is used
  builder->guarded([&] { builder->fail_undeclared(name); });
}

int Builder::on_external_entity(XML_Parser argument, const XML_Char* context, const XML_Char* base,
                                const XML_Char* system_id, const XML_Char*) {
  // XML_SetExternalEntityRefHandlerArg put the builder in the parser's place.
  auto* builder = reinterpret_cast<Builder*>(argument);
  builder->guarded([&] {
    builder->external_entity(context, base != nullptr ? base : "",
                             system_id != nullptr ? system_id : "");
  });
  const bool good = builder->problem_.empty() && !builder->out_of_memory_;
  return good ? XML_STATUS_OK : XML_STATUS_ERROR;
}

void Builder::external_entity(const XML_Char* context, const char* base, const char* system_id) {
  std::string name = system_id;
  const std::string what = "external entity '" + printable(name) + "' ";
  // Declarations, of a DTD or a parameter entity; a file that uses none can do without them.
  const bool declarations = context == nullptr;
  if (name.starts_with("file:")) {
    name.erase(0, 5);
    if (name.starts_with("//")) name.erase(0, 2);
  } else if (name.find("://") != std::string::npos) {
    if (declarations) {
      unread_ = what + "is on a network and is not fetched";
      return;
    }
    return stop(here() + what + "is on a network and is not fetched; save it beside the file");
  }
  if (sources_.size() > max_entity_nesting) {
    return stop(here() + what + "is nested too deep; does it include itself?");
  }
  fs::path path = fs::path(base).parent_path() / name;
  std::error_code error;
  if (!fs::exists(path, error)) path = fs::path(base).parent_path() / percent_decoded(name);
  const Expected<std::string> text = read_file(path);
  if (!text) {
    if (declarations) {
      unread_ = what + "cannot be read: " + text.failure().message;
      return;
    }
    return stop(here() + what + "cannot be read: " + printable_path(path.string()) + ": " +
                text.failure().message);
  }
  const ParserPtr parser(XML_ExternalEntityParserCreate(sources_.back().parser, context, nullptr));
  if (parser == nullptr) throw std::bad_alloc();
  parse_text(parser.get(), document_.files.emplace_back(path.string()), *text);
}

Expected<std::string> Builder::read_file(const fs::path& path) {
  Expected<std::string> read = read_regular_file(
      path, budget_.bytes, "too much text; raise GdmlLimits::max_bytes if this is meant");
  if (!read) return read;
  std::string text = *std::move(read);
  if (is_gzipped(text)) {
    Expected<std::string> unpacked = unpack_gzip(text, budget_.bytes);
    if (!unpacked) return unpacked;
    text = *std::move(unpacked);
  }
  budget_.bytes -= text.size();
  return text;
}

void Builder::parse_text(XML_Parser parser, const std::string& file, const std::string& text) {
  sources_.push_back({parser, &file});
  XML_SetBase(parser, file.c_str());
  // As few pieces as expat's int allows: with each it looks again at an unfinished token.
  constexpr std::size_t piece = std::size_t{1} << 30;
  XML_Status status = XML_STATUS_OK;
  std::size_t begin = 0;
  do {
    const std::size_t size = std::min(piece, text.size() - begin);
    const bool last = begin + size == text.size();
    status = XML_Parse(parser, text.data() + begin, static_cast<int>(size), last);
    begin += size;
  } while (status == XML_STATUS_OK && begin < text.size());
  if (status != XML_STATUS_OK && problem_.empty() && !out_of_memory_) {
    const XML_Error error = XML_GetErrorCode(parser);
    if (error == XML_ERROR_NO_MEMORY) {
      out_of_memory_ = true;
    } else if (document_.root != nullptr && open_.empty()) {
      document_.ends_in_junk = true;  // The tree is whole; Geant4 reads it, too.
    } else if (text.empty()) {
      problem_ = printable_path(file) + ":1: the file is empty";
    } else if (error == XML_ERROR_UNKNOWN_ENCODING) {
      problem_ = here() + "the encoding '" + printable(unknown_encoding_) +
                 "' is not known; convert the file to UTF-8, and say so in its first line";
    } else {
      problem_ = here() + "not well-formed XML: " + XML_ErrorString(error);
    }
  }
  sources_.pop_back();
}

void Builder::parse_document(const fs::path& path, const XmlElement* from) {
  const Expected<std::string> text = read_file(path);
  if (!text) {
    const std::string& problem = text.failure().message;
    if (from != nullptr) {
      fail(*from, "cannot be read: " + printable_path(path.string()) + ": " + problem);
    }
    throw GdmlError(printable_path(path.string()) + ":0: cannot be read: " + problem);
  }
  const ParserPtr owner(XML_ParserCreate(nullptr));
  if (owner == nullptr) throw std::bad_alloc();
  XML_Parser parser = owner.get();
  XML_SetUserData(parser, this);
  XML_SetElementHandler(parser, on_start, on_end);
  XML_SetCharacterDataHandler(parser, on_text);
  XML_SetUnknownEncodingHandler(parser, on_unknown_encoding, &unknown_encoding_);
  XML_SetEntityDeclHandler(parser, on_entity);
  XML_SetSkippedEntityHandler(parser, on_skipped_entity);
  XML_SetExternalEntityRefHandler(parser, on_external_entity);
  XML_SetExternalEntityRefHandlerArg(parser, this);
  XML_SetParamEntityParsing(parser, XML_PARAM_ENTITY_PARSING_ALWAYS);
  parse_text(parser, document_.files.emplace_back(path.string()), *text);
  if (out_of_memory_) throw std::bad_alloc();
  if (!problem_.empty()) throw GdmlError(problem_);
}

}  // namespace

std::unique_ptr<XmlDocument> parse_xml(const fs::path& path, const GdmlLimits& limits,
                                       XmlBudget& budget, const XmlElement* from) {
  auto document = std::make_unique<XmlDocument>();
  Builder(*document, limits, budget).parse_document(path, from);
  return document;
}

}  // namespace navjit::gdml
