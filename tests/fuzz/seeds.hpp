// Small GDML files, which together have every element that the reader knows.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace navjit::fuzz {

struct Seed {
  std::string name, text;
};

inline std::string seed_file(const std::string& define, const std::string& materials,
                             const std::string& solids, const std::string& structure,
                             const std::string& doctype = "") {
  return "<?xml version='1.0'?>" + doctype + "<gdml><define>" + define + "</define><materials>" +
         materials + "</materials><solids><box name='w' x='60' y='60' z='60'/>" + solids +
         "</solids><structure>" + structure +
         "</structure><setup name='Default' version='1.0'><world ref='W'/></setup></gdml>";
}

inline std::string seed_volume(const std::string& name, const std::string& solid,
                               const std::string& content = "") {
  return "<volume name='" + name + "'><materialref ref='G4_Pb'/><solidref ref='" + solid + "'/>" +
         content + "</volume>";
}

/// A file that places, turned, the solid 's' of this text.
inline std::string seed_solid(const std::string& solids) {
  return seed_file(
      "", "", solids,
      seed_volume("S", "s") + seed_volume("W", "w",
                                          "<physvol><volumeref ref='S'/><position x='1' unit='cm'/>"
                                          "<rotation x='30' z='40' unit='deg'/></physvol>"));
}

inline std::vector<Seed> seeds() {
  std::vector<Seed> all;
  const std::pair<const char*, const char*> solids[] = {
      {"box", "<box name='s' x='2' y='3' z='1' lunit='cm'/>"},
      {"tube",
       "<tube name='s' rmin='2' rmax='8' z='20' startphi='10' deltaphi='200' aunit='deg'/>"},
      {"cone", "<cone name='s' rmin1='1' rmax1='4' rmin2='2' rmax2='9' z='20' deltaphi='4'/>"},
      {"trd", "<trd name='s' x1='4' x2='8' y1='6' y2='3' z='20'/>"},
      {"trap",
       "<trap name='s' z='9' theta='0.1' phi='0.2' y1='4' x1='4' x2='4' alpha1='0.1' y2='4' x3='4' "
       "x4='6' alpha2='0.1'/>"},
      {"para", "<para name='s' x='9' y='8' z='7' alpha='20' theta='10' phi='40' aunit='deg'/>"},
      {"orb", "<orb name='s' r='9'/>"},
      {"sphere",
       "<sphere name='s' rmin='2' rmax='9' startphi='1' deltaphi='4' starttheta='0.3' "
       "deltatheta='2'/>"},
      {"torus", "<torus name='s' rmin='1' rmax='3' rtor='9' startphi='1' deltaphi='4'/>"},
      {"wide_torus", "<torus name='s' rmin='1' rmax='9' rtor='5' deltaphi='7'/>"},
      {"polycone",
       "<polycone name='s' startphi='1' deltaphi='4'><zplane z='-9' rmin='1' rmax='3'/><zplane "
       "z='0' "
       "rmin='1' rmax='9'/><zplane z='0' rmin='2' rmax='4'/><zplane z='9' rmin='3' "
       "rmax='4'/></polycone>"},
      {"polyhedra",
       "<polyhedra name='s' numsides='5' startphi='0' deltaphi='7'><zplane z='-9' rmin='1' "
       "rmax='3'/>"
       "<zplane z='9' rmin='3' rmax='4'/></polyhedra>"},
      {"genericPolycone",
       "<genericPolycone name='s' startphi='0' deltaphi='7'><rzpoint r='1' z='-9'/><rzpoint r='9' "
       "z='-9'/><rzpoint r='4' z='9'/></genericPolycone>"},
      {"genericPolyhedra",
       "<genericPolyhedra name='s' numsides='4' startphi='0' deltaphi='4'><rzpoint r='1' z='-9'/>"
       "<rzpoint r='9' z='-9'/><rzpoint r='4' z='9'/></genericPolyhedra>"},
      {"ellipsoid", "<ellipsoid name='s' ax='9' by='8' cz='7' zcut1='-5' zcut2='6'/>"},
      {"eltube", "<eltube name='s' dx='9' dy='8' dz='7'/>"},
      {"elcone", "<elcone name='s' dx='1' dy='2' zmax='9' zcut='5'/>"},
      {"paraboloid", "<paraboloid name='s' rlo='1' rhi='9' dz='8'/>"},
      {"hype", "<hype name='s' rmin='2' rmax='6' inst='0.2' outst='0.5' z='20'/>"},
      {"twistedbox", "<twistedbox name='s' PhiTwist='1' x='9' y='8' z='20'/>"},
      {"twistedtrd", "<twistedtrd name='s' PhiTwist='1' x1='9' x2='4' y1='8' y2='6' z='20'/>"},
      {"twistedtrap",
       "<twistedtrap name='s' PhiTwist='0.6' z='9' Theta='0.1' Phi='1' y1='4' x1='4' x2='4' y2='4' "
       "x3='4' x4='6' Alph='0.1'/>"},
      {"twistedtubs",
       "<twistedtubs name='s' twistedangle='1' endinnerrad='2' endouterrad='8' zlen='20' "
       "phi='1'/>"},
      {"xtru",
       "<xtru name='s'><twoDimVertex x='0' y='0'/><twoDimVertex x='9' y='0'/><twoDimVertex x='0' "
       "y='9'/><section zOrder='0' zPosition='-9' xOffset='0' yOffset='0' "
       "scalingFactor='1'/><section "
       "zOrder='1' zPosition='9' xOffset='1' yOffset='0' scalingFactor='0.5'/></xtru>"},
      {"arb8",
       "<arb8 name='s' dz='9' v1x='-9' v1y='-9' v2x='-9' v2y='9' v3x='9' v3y='9' v4x='9' v4y='-9' "
       "v5x='-5' v5y='-5' v6x='-3' v6y='6' v7x='4' v7y='5' v8x='5' v8y='-5'/>"},
      {"cutTube",
       "<cutTube name='s' rmin='1' rmax='9' z='20' startphi='0' deltaphi='4' lowX='0' lowY='-0.3' "
       "lowZ='-1' highX='0.2' highY='0' highZ='1'/>"},
      {"union",
       "<orb name='o' r='4'/><union name='s'><first ref='w'/><second ref='o'/><position x='30'/>"
       "<rotation y='1'/></union>"},
      {"subtraction",
       "<orb name='o' r='9'/><box name='b' x='9' y='9' z='9'/><subtraction name='s'><first "
       "ref='o'/>"
       "<second ref='b'/><position x='3'/><firstposition z='2'/></subtraction>"},
      {"intersection",
       "<orb name='o' r='9'/><box name='b' x='9' y='9' z='9'/><intersection name='s'><first "
       "ref='o'/>"
       "<second ref='b'/><position x='3'/></intersection>"},
      {"multiUnion",
       "<orb name='o' r='4'/><multiUnion name='s'><multiUnionNode name='n'><solid "
       "ref='o'/><position "
       "x='5'/></multiUnionNode><multiUnionNode name='m'><solid "
       "ref='o'/></multiUnionNode></multiUnion>"},
      {"scaledSolid",
       "<orb name='o' r='4'/><scaledSolid name='s'><solidref ref='o'/><scale name='k' x='1' y='2' "
       "z='-3'/></scaledSolid>"},
      {"reflectedSolid",
       "<orb name='o' r='4'/><reflectedSolid name='s' solid='o' sx='-1' sy='1' sz='1' rx='0.5' "
       "dx='3'/>"},
  };
  for (const auto& [name, text] : solids) all.push_back({name, seed_solid(text)});
  all.push_back({"corners",
                 seed_file("<position name='a' x='0'/><position name='b' x='9'/><position name='c' "
                           "y='9'/><position name='d' z='9'/>",
                           "",
                           "<tet name='t' vertex1='a' vertex2='b' vertex3='c' vertex4='d'/>"
                           "<tessellated name='s'><triangular vertex1='a' vertex2='c' vertex3='b' "
                           "type='ABSOLUTE'/><triangular vertex1='a' vertex2='b' vertex3='d'/>"
                           "<triangular vertex1='a' vertex2='d' vertex3='c'/><triangular "
                           "vertex1='b' vertex2='c' vertex3='d'/></tessellated>",
                           seed_volume("S", "s") + seed_volume("T", "t") +
                               seed_volume("W", "w",
                                           "<physvol><volumeref ref='S'/></physvol><physvol>"
                                           "<volumeref ref='T'/><position x='-9'/></physvol>"))});
  all.push_back(
      {"define",
       seed_file("<constant name='c' value='2*cm'/><variable name='i' value='0'/><quantity "
                 "name='q' value='3' unit='mm'/><expression name='e'>c/2+q</expression>"
                 "<matrix name='m' coldim='2' values='1 2 3 4'/><position name='p' x='m[1,2]' "
                 "y='e' unit='mm'/><rotation name='r' z='pi/4'/><scale name='k' x='-1'/>",
                 "", "<box name='b' x='c' y='e' z='m[2,1]'/>",
                 seed_volume("B", "b") +
                     seed_volume("W", "w",
                                 "<physvol name='v' copynumber='3'><volumeref ref='B'/>"
                                 "<positionref ref='p'/><rotationref ref='r'/><scaleref "
                                 "ref='k'/></physvol><loop for='i' from='1' to='4' step='1'>"
                                 "<physvol><volumeref ref='B'/><position z='5*i'/></physvol>"
                                 "</loop>"))});
  all.push_back(
      {"materials",
       seed_file("<quantity name='d' value='7' unit='g/cm3'/>",
                 "<isotope name='U5' Z='92' N='235'><atom value='235' unit='g/mole'/>"
                 "</isotope><element name='U' formula='U'><fraction ref='U5' n='1'/></element>"
                 "<element name='O' Z='8'><atom value='16'/></element><material name='UO2' "
                 "state='solid'><T value='300' unit='K'/><P value='1' unit='atmosphere'/>"
                 "<D value='10' unit='g/cm3'/><composite n='1' ref='U'/><composite n='2' "
                 "ref='O'/></material><material name='mix'><Dref ref='d'/><fraction n='0.4' "
                 "ref='UO2'/><fraction n='0.6' ref='O'/></material><material name='Al' "
                 "Z='13'><D value='2.7'/><atom value='27'/></material>",
                 "", "<volume name='W'><materialref ref='mix'/><solidref ref='w'/></volume>")});
  const auto divided = [](const char* mother, const char* daughter, const char* rest) {
    return seed_file("", "", std::string(mother) + daughter,
                     seed_volume("D", "d") +
                         seed_volume("M", "m",
                                     std::string("<divisionvol ") + rest +
                                         "><volumeref ref='D'/></divisionvol>") +
                         seed_volume("W", "w", "<physvol><volumeref ref='M'/></physvol>"));
  };
  all.push_back(
      {"division_tube", divided("<tube name='m' rmin='2' rmax='9' z='9' deltaphi='4'/>",
                                "<tube name='d' rmin='2' rmax='9' z='9' deltaphi='1'/>",
                                "axis='kPhi' number='4' width='1' offset='0' unit='rad'")});
  all.push_back(
      {"division_cone",
       divided("<cone name='m' rmin1='2' rmax1='9' rmin2='1' rmax2='4' z='9' deltaphi='4'/>",
               "<cone name='d' rmin1='2' rmax1='9' rmin2='1' rmax2='4' z='9' deltaphi='4'/>",
               "axis='kRho' number='4' unit='mm'")});
  all.push_back({"division_trd", divided("<trd name='m' x1='9' x2='4' y1='8' y2='9' z='9'/>",
                                         "<trd name='d' x1='9' x2='4' y1='8' y2='9' z='9'/>",
                                         "axis='kXAxis' width='2' offset='1' unit='mm'")});
  all.push_back({"division_para",
                 divided("<para name='m' x='9' y='8' z='7' alpha='0.1' theta='0.2' phi='1'/>",
                         "<para name='d' x='9' y='8' z='7' alpha='0.1' theta='0.2' phi='1'/>",
                         "axis='kYAxis' number='3'")});
  const char* planes =
      "<zplane z='-9' rmin='1' rmax='3'/><zplane z='2' rmin='1' rmax='9'/><zplane z='9' rmin='3' "
      "rmax='4'/>";
  for (const std::string kind : {"polycone", "polyhedra"}) {
    const std::string start = " numsides='3' deltaphi='4'>",
                      end = std::string(planes) + "</" + kind + ">";
    const std::string mother = "<" + kind + " name='m'" + start + end;
    const std::string daughter = "<" + kind + " name='d'" + start + end;
    all.push_back({"division_" + kind,
                   divided(mother.c_str(), daughter.c_str(), "axis='kZAxis' number='2'")});
  }
  all.push_back(
      {"replicas",
       seed_file(
           "", "", "<tube name='t' rmax='9' z='9' deltaphi='7'/>",
           seed_volume("T", "t") +
               seed_volume("M", "t",
                           "<replicavol number='3'><volumeref ref='T'/><replicate_along_axis>"
                           "<direction rho='1'/><width value='3' unit='mm'/><offset value='0' "
                           "unit='mm'/></replicate_along_axis></replicavol>") +
               seed_volume("W", "w",
                           "<replicavol number='2'><volumeref ref='M'/><replicate_along_axis>"
                           "<direction z='1'/><width value='30' unit='mm'/><offset value='0' "
                           "unit='mm'/></replicate_along_axis></replicavol>"))});
  all.push_back(
      {"paramvol",
       seed_file(
           "<variable name='i' value='0'/>", "", "<tube name='t' rmax='9' z='9' deltaphi='7'/>",
           seed_volume("T", "t") +
               seed_volume("W", "w",
                           "<paramvol ncopies='3'><volumeref ref='T'/><loop for='i' from='1' "
                           "to='3' step='1'><parameterised_position_size><parameters number='i'>"
                           "<tube_dimensions InR='0' OutR='i' hz='4' StartPhi='0' DeltaPhi='7'/>"
                           "<position z='10*i-20'/></parameters></parameterised_position_size>"
                           "</loop></paramvol>"))});
  all.push_back(
      {"assembly",
       seed_file("", "", "<orb name='o' r='2'/><opticalsurface name='x'/>",
                 seed_volume("O", "o", "<auxiliary auxtype='Color' auxvalue='red'/>") +
                     "<assembly name='A'><physvol><volumeref ref='O'/><position x='5'/></physvol>"
                     "<physvol><volumeref ref='O'/><position y='5'/></physvol></assembly>" +
                     seed_volume("W", "w", "<physvol name='p'><volumeref ref='A'/></physvol>") +
                     "<skinsurface name='k' surfaceproperty='x'><volumeref ref='O'/></skinsurface>",
                 "<!DOCTYPE gdml [<!ENTITY e 'x'>]>")});
  // What loads with a note: most of it is broken, and nothing uses it.
  all.push_back(
      {"tolerant",
       seed_file("<constant name='c' value='1+'/><constant name='d' value='c'/><constant "
                 "name='d' value='2'/><matrix name='m' coldim='2' values='1 2 3,5 4'/><quantity "
                 "name='q' value='' unit=''/><quantity name='f' value='1' unit='MHz'/><position "
                 "x='1'/><position name='p' x='c'/><tensor name='t'/><auxiliary auxtype='a'/>",
                 "<isotope name='I' Z='x' N='2'/><element name='E' formula='E' Z='8'><atom "
                 "value='16' unit='g/mol'/><fraction ref='I' n='1'/></element><material "
                 "name='M'><D value='-1' unit='stone'/><T value='20' unit='degC'/><P value='1' "
                 "unit='mbar'/><fraction n='?' ref='E'/><composite n='1' ref='E'/></material>",
                 "<box name='s' x='c' y='' z='1'/><union name='u'><first ref='s'/><second "
                 "ref='w'/></union><orb r='2'/><orb name='o' r='2'/>",
                 seed_volume("V", "u") +
                     "<assembly name='A'><physvol><volumeref ref='V'/>"
                     "</physvol></assembly>" +
                     seed_volume("O", "o",
                                 "<auxiliary auxtype='a' auxvalue='b' auxunit='mm'><auxiliary "
                                 "auxtype='c'/></auxiliary>") +
                     seed_volume("W", "w",
                                 "<physvol><volumeref ref='O'/><position x='m[1,2]' y=''/>"
                                 "<auxiliary auxtype='d' auxvalue='e'/></physvol>") +
                     "</structure><userinfo><auxiliary auxtype='f'/></userinfo><what/><structure>",
                 "<!DOCTYPE gdml [<!ENTITY a '&b;'><!ENTITY b '1'>]>")});
  return all;
}

}  // namespace navjit::fuzz
