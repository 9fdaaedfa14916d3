// Entities, encodings, and what hostile XML may try.
#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

class GdmlXml : public GdmlFiles {};

std::string doctype(const std::string& entities) { return "<!DOCTYPE gdml [" + entities + "]>"; }

TEST_F(GdmlXml, ReadsEntitiesRelativeToTheirOwnFile) {
  write("parts/solids.xml", "<box name='inner' x='2' y='4' z='6'/>\n&more;");
  write("parts/deep/more.xml",
        "<?xml version='1.0' encoding='UTF-8'?><box name='second' x='8' y='8' z='8'/>");
  const auto path =
      write("det.gdml",
            Gdml{.solids = "&solids;",
                 .structure = "<volume name='W'><materialref ref='G4_AIR'/><solidref ref='second'/>"
                              "</volume>",
                 .doctype = doctype("<!ENTITY solids SYSTEM 'parts/solids.xml'>"
                                    "<!ENTITY more SYSTEM 'parts/deep/more.xml'>")});
  const World world = read_world(path);
  EXPECT_EQ(top(world).solid.name, "second");
  EXPECT_EQ(top(world).solid.extent.max.x, 4);
}

TEST_F(GdmlXml, ReadsFileUrls) {
  const auto part = write("part.xml", "<box name='other' x='2' y='2' z='2'/>");
  const World world =
      read(Gdml{.solids = "&part;",
                .structure = volume("W"),
                .doctype = doctype("<!ENTITY part SYSTEM 'file://" + part.string() + "'>")});
  EXPECT_EQ(top(world).name, "W");
}

TEST_F(GdmlXml, NamesTheEntityFileInErrors) {
  write("part.xml", "<box name='first' x='2' y='2' z='2'/>\n<box name='bad' x='-2' y='2' z='2'/>");
  const std::string message =
      error_of(Gdml{.solids = "&part;",
                    .structure = "<volume name='W'><solidref ref='bad'/></volume>",
                    .doctype = doctype("<!ENTITY part SYSTEM 'part.xml'>")});
  EXPECT_HAS(message, "part.xml:2: <box name='bad'>: ");
}

TEST_F(GdmlXml, ReadsInternalEntities) {
  const World world = read(Gdml{.define = "<constant name='c' value='&size;'/>",
                                .solids = "<box name='c' x='c' y='c' z='c'/>",
                                .structure = "<volume name='W'><materialref ref='G4_AIR'/>"
                                             "<solidref ref='c'/></volume>",
                                .doctype = doctype("<!ENTITY size '2*&five;'>"
                                                   "<!ENTITY five '5'>")});
  EXPECT_EQ(top(world).solid.extent.max.z, 5);
}

TEST_F(GdmlXml, RefusesEntityBombs) {
  std::string entities = "<!ENTITY a0 '<position/>'>";
  for (int i = 1; i < 12; ++i) {
    std::string ten;
    for (int k = 0; k < 10; ++k) ten += "&a" + std::to_string(i - 1) + ';';
    entities += "<!ENTITY a" + std::to_string(i) + " '" + ten + "'>";
  }
  EXPECT_HAS(error_of(Gdml{.define = "&a11;", .doctype = doctype(entities)}), "det.gdml:");
  EXPECT_HAS(
      error_of(Gdml{.define = "<constant name='c' value='&a11;'/>", .doctype = doctype(entities)}),
      "det.gdml:");
}

TEST_F(GdmlXml, RefusesLongChainsOfEntities) {
  const auto chain = [](int length) {
    std::string entities = "<!ENTITY a0 '1'>";
    for (int i = 1; i < length; ++i) {
      entities += "<!ENTITY a" + std::to_string(i) + " '&a" + std::to_string(i - 1) + ";'>";
    }
    const std::string last = "&a" + std::to_string(length - 1) + ';';
    return Gdml{.define = "<constant name='c' value='" + last + "'/>",
                .structure = volume("W"),
                .doctype = doctype(entities)};
  };
  EXPECT_EQ(top(read(chain(1000))).name, "W");
  EXPECT_HAS(error_of(chain(100'000)), "refer to one another");
  // Declared from the other end, and followed by the parser before the declarations end.
  std::string forwards;
  for (int i = 0; i < 90'000; ++i) {
    forwards += "<!ENTITY a" + std::to_string(i) + " '&a" + std::to_string(i + 1) + ";'>";
  }
  forwards += "<!ENTITY a90000 '1'><!ATTLIST gdml x CDATA '&a0;'>";
  EXPECT_HAS(error_of(Gdml{.structure = volume("W"), .doctype = doctype(forwards)}),
             "refer to one another");
}

TEST_F(GdmlXml, FetchesNothingFromNetworks) {
  for (const char* url : {"http://example.com/a.xml", "https://example.com/a", "ftp://x/y"}) {
    EXPECT_HAS(error_of(Gdml{.define = "&a;",
                             .doctype = doctype(std::string("<!ENTITY a SYSTEM '") + url + "'>")}),
               "is not fetched");
  }
  // A schema's address is no reason to look there.
  const World world = read(
      "<gdml xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance' "
      "xsi:noNamespaceSchemaLocation='http://example.com/gdml.xsd'><solids><box name='b' x='2' "
      "y='2' z='2'/></solids><structure><volume name='W'><materialref ref='G4_AIR'/><solidref "
      "ref='b'/></volume></structure><setup name='s' version='1'><world ref='W'/></setup></gdml>");
  EXPECT_EQ(top(world).name, "W");
}

TEST_F(GdmlXml, RefusesEntitiesThatCannotBeRead) {
  const auto with = [&](const std::string& target) {
    return error_of(
        Gdml{.define = "\n&a;", .doctype = doctype("<!ENTITY a SYSTEM '" + target + "'>")});
  };
  EXPECT_HAS(with("missing.xml"),
             "det.gdml:4: in <define>: external entity "
             "'missing.xml' cannot be read");
  EXPECT_HAS(with("."), "directory");
  EXPECT_HAS(with("/dev/zero"), "not a regular file");
  EXPECT_HAS(with("det.gdml"), "det.gdml:");  // includes itself
  write("self.xml", "&a;");
  EXPECT_HAS(with("self.xml"), "recursive");
  EXPECT_HAS(error_of(Gdml{.define = "&nothing;"}), "undefined entity");
  EXPECT_HAS(error_of(Gdml{.define = "&nothing;", .doctype = "<!DOCTYPE gdml SYSTEM 'a.dtd'>"}),
             "'&nothing;' is not declared");
}

TEST_F(GdmlXml, RefusesDeepNesting) {
  std::string text;
  for (int i = 0; i < 1'000'000; ++i) text += "<a>";
  EXPECT_HAS(error_of(text), "nested more than 1000 deep");
  // As deep as allowed, with every level read.
  std::string loops, ends;
  for (int i = 0; i < 900; ++i) {
    loops += "<loop for='i' from='1' to='1' step='1'>";
    ends += "</loop>";
  }
  EXPECT_EQ(top(read(Gdml{.define = "<variable name='i' value='0'/>",
                          .structure = loops + volume("W") + ends}))
                .name,
            "W");
}

TEST_F(GdmlXml, RefusesTooMuchText) {
  GdmlOptions few;
  few.limits.max_elements = 10;
  EXPECT_HAS(error_of(Gdml{.structure = volume("W")}, few), "too many XML elements");
  GdmlOptions small;
  small.limits.max_bytes = 100;
  EXPECT_HAS(error_of(Gdml{.structure = volume("W")}, small), "too much text");
}

TEST_F(GdmlXml, NamesTheLineOfBrokenXml) {
  EXPECT_HAS(error_of("<gdml>\n<define>\n<constant name='c' value='1'>\n</define>"),
             "det.gdml:4: in <constant name='c'>: not well-formed XML: mismatched tag");
  EXPECT_HAS(error_of("<gdml>\n<define>\n"), "det.gdml:3: in <define>: not well-formed");
  EXPECT_HAS(error_of("<gdml>\n<a b='1' b='2'/></gdml>"), "det.gdml:2: ");
  EXPECT_HAS(error_of(""), "det.gdml:1: the file is empty");
  EXPECT_HAS(error_of("  \n "), "no element found");
  EXPECT_HAS(error_of(std::string(100'000, '\0')), "det.gdml:1: ");
  EXPECT_HAS(error_of("\xff\xfe\x80\x81 binary \x01\x02"), "det.gdml:");
  EXPECT_HAS(error(folder_ / "none.gdml"), "none.gdml:0: cannot be read: no such file");
  EXPECT_HAS(error(folder_), "it is a directory");
  // What a clone has in the place of a large file until it is fetched.
  EXPECT_HAS(
      error_of("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 5\n"),
      "det.gdml:0: cannot be read: it is a Git LFS pointer, not the file itself; 'git lfs pull'");
}

TEST_F(GdmlXml, EveryTruncationIsAnErrorAndNothingElse) {
  const std::string text = Gdml{.structure = volume("W", physvol("D"))};
  const auto last = text.rfind("</gdml>");
  for (std::size_t length = 0; length < last; length += 3) {
    const std::string message = error_of(text.substr(0, length));
    EXPECT_HAS(message, "det.gdml:") << length;
    EXPECT_LACKS(message, "\n") << length;
  }
}

TEST_F(GdmlXml, EveryChangedByteIsReadOrRefused) {
  const std::string text = Gdml{
      .define = "<variable name='i' value='1'/><matrix name='m' coldim='2' values='1 2 3 4'/>",
      .solids = "<union name='u'><first ref='b'/><second ref='b'/><position x='m[1,2]'/></union>",
      .structure =
          volume("W", "<loop for='i' from='1' to='2' step='1'>" +
                          physvol("D", "<rotation x='90' unit='deg'/>", "p[i]") + "</loop>")};
  int read_well = 0, refused = 0;
  const std::string replacements{'\0', '<', '9', '&', '\'', 'x', '-', ' ', ']'};
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string changed = text;
    changed[i] = replacements[i % replacements.size()];
    const auto path = write("det.gdml", changed);
    try {
      read_world(path);
      ++read_well;
    } catch (const GdmlError&) {
      ++refused;
    }
  }
  EXPECT_GT(read_well, 0);
  EXPECT_GT(refused, 0);
}

TEST_F(GdmlXml, ReadsOtherEncodings) {
  const std::string body = std::string(Gdml{.structure = volume("W")}).substr(21);
  const auto declared = [&](const std::string& encoding) {
    return "<?xml version='1.0' encoding='" + encoding + "'?>" + body;
  };
  for (const char* encoding : {"ASCII", "US-ASCII", "UTF-8", "UTF8", "utf8", "ISO-8859-1",
                               "ISO-8859-15", "ISO8859-1", "latin1", "LATIN-1", "L1", "cp1252"}) {
    EXPECT_EQ(top(read(declared(encoding))).name, "W") << encoding;
  }
  EXPECT_HAS(error_of(declared("EBCDIC")),
             "det.gdml:1: the encoding 'ebcdic' is not known; convert the file to UTF-8");
}

TEST_F(GdmlXml, ReadsUtf8UnderItsWrongName) {
  const auto named = [](const std::string& encoding, const std::string& name) {
    return "<?xml version='1.0' encoding='" + encoding + "'?>" +
           std::string(Gdml{.structure = volume(name), .world = name}).substr(21);
  };
  const auto name_of = [&](const std::string& encoding, const std::string& name) {
    return top(read(named(encoding, name))).name;
  };
  for (const char* name : {"Caf\u00e9", "\u0416", "\u03b3-\u20ac-\uffee"}) {
    EXPECT_EQ(name_of("UTF8", name), name_of("UTF-8", name)) << name;
    EXPECT_EQ(name_of("UTF8", name), name);
  }
  EXPECT_EQ(name_of("UTF8", "a\U0001F600"), "a\ufffd") << "no character of its own";
  for (const char* broken : {"\xc3", "\xc3\x28", "\xe2\x82", "\xc0\xaf", "\xe0\x80\xaf",
                             "\xed\xa0\x80", "\xff", "\xf5\x80\x80\x80"}) {
    EXPECT_HAS(error_of(named("UTF8", broken)), "not well-formed");
  }
}

TEST_F(GdmlXml, MessagesAreOneLine) {
  const std::string message =
      error_of(Gdml{.structure = "<volume name='a&#10;b&#9;c'><solidref ref='" +
                                 std::string(400, 'x') + "&#10;y'/></volume>"});
  EXPECT_LACKS(message, "\n");
  EXPECT_LT(message.size(), 1000u);
}

TEST_F(GdmlXml, ReadsDeclarationsOfParameterEntitiesAndDtds) {
  write("names.ent", "<!ENTITY which 'D'><!ENTITY off '7'>");
  const std::string structure =
      volume("W", "<physvol><volumeref ref='&which;'/><position x='&off;'/></physvol>");
  for (const std::string& declared :
       {doctype("<!ENTITY % names SYSTEM 'names.ent'> %names;"),
        doctype("<!ENTITY % names \"<!ENTITY which 'D'><!ENTITY off '7'>\"> %names;"),
        std::string("<!DOCTYPE gdml SYSTEM 'names.ent'>")}) {
    const World world = read(Gdml{.structure = structure, .doctype = declared});
    ASSERT_EQ(top(world).daughters.size(), 1U) << declared;
    EXPECT_EQ(world.volumes[top(world).daughters[0].volume].name, "D");
    EXPECT_EQ(top(world).daughters[0].transformation.translation[0], 7) << declared;
  }
}

TEST_F(GdmlXml, DeclarationsThatCannotBeReadMatterOnlyToWhoUsesThem) {
  for (const std::string& declared :
       {std::string("<!DOCTYPE gdml SYSTEM 'none.dtd'>"),
        std::string("<!DOCTYPE gdml SYSTEM 'http://example.org/gdml.dtd'>"),
        doctype("<!ENTITY % names SYSTEM 'none.ent'> %names;")}) {
    EXPECT_EQ(top(read(Gdml{.structure = volume("W"), .doctype = declared})).name, "W");
    // Expat would take it for nothing: a position of 0, a box of 1 mm.
    for (const std::string& used :
         {volume("W", physvol("D", "<position x='&off;'/>")),
          volume("W", physvol("D", "<position x='1&off;'/>")), volume("W&off;")}) {
      EXPECT_HAS(error_of(Gdml{.structure = used, .doctype = declared}),
                 "entity '&off;' is not declared, or where it could not be read: external entity");
    }
    const World known = read(Gdml{.define = "<constant name='c' value='1&lt;2'/>",
                                  .structure = volume("W"),
                                  .doctype = declared});
    EXPECT_EQ(top(known).name, "W");
  }
}

TEST_F(GdmlXml, FindsFilesWhoseNamesAreUris) {
  write("two words.xml", "<box name='other' x='2' y='2' z='2'/>");
  const World world = read(Gdml{.solids = "&part;",
                                .structure = "<volume name='W'><solidref ref='other'/></volume>",
                                .doctype = doctype("<!ENTITY part SYSTEM 'two%20words.xml'>")});
  EXPECT_EQ(top(world).solid.name, "other");
}

TEST_F(GdmlXml, ParameterEntitiesAreBounded) {
  std::string many;
  for (int i = 0; i < 2000; ++i) many += "<!ENTITY % p" + std::to_string(i) + " ''>";
  EXPECT_HAS(error_of(Gdml{.structure = volume("W"), .doctype = doctype(many)}),
             "more than 1000 parameter entities");
}

}  // namespace
}  // namespace navjit::testing
