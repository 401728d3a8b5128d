// Small IFC files: what every one holds, and elements for them.
#pragma once

#include <fmt/core.h>
#include <string>
#include <string_view>

namespace triptych::test {

inline constexpr std::string_view metres = "#7=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n";
inline constexpr std::string_view millimetres = "#7=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);\n";

/// A unit by conversion from metres, as exporters write feet and inches.
inline std::string converted_unit(std::string_view name, std::string_view in_metres) {
  return fmt::format(
      "#90=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n#91=IFCDIMENSIONALEXPONENTS(1,0,0,0,0,0,0);\n"
      "#92=IFCMEASUREWITHUNIT(IFCRATIOMEASURE({}),#90);\n#7=IFCCONVERSIONBASEDUNIT(#91,.LENGTHUNIT.,'{}',#92)"
      ";\n",
      in_metres, name);
}

/// A file whose entities up to #99 are taken: project #13, a storey #17 named "First floor" in building #15,
/// its placement #14, the context #12, origin #8, z #9, x #10, axes #11; in two dimensions origin #20, axes
/// #22.
inline std::string ifc_file(std::string_view elements, std::string_view unit = metres,
                            std::string_view schema = "IFC4", std::string_view contained = "#100") {
  return fmt::format(
      "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('ViewDefinition [CoordinationView]'),'2;1');\n"
      "FILE_NAME('t.ifc','2020-01-01T00:00:00',('a'),('b'),'c','d','e');\nFILE_SCHEMA(('{}'));\nENDSEC;"
      "\nDATA;\n"
      "#1=IFCPERSON($,$,'a',$,$,$,$,$);\n#2=IFCORGANIZATION($,'b',$,$,$);\n"
      "#3=IFCPERSONANDORGANIZATION(#1,#2,$);\n#4=IFCAPPLICATION(#2,'1','c','d');\n"
      "#5=IFCOWNERHISTORY(#3,#4,$,.ADDED.,$,$,$,0);\n{}#6=IFCUNITASSIGNMENT(({}));\n"
      "#8=IFCCARTESIANPOINT((0.,0.,0.));\n#9=IFCDIRECTION((0.,0.,1.));\n#10=IFCDIRECTION((1.,0.,0.));\n"
      "#11=IFCAXIS2PLACEMENT3D(#8,#9,#10);\n"
      "#12=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#11,$);\n"
      "#13=IFCPROJECT('0YvctVUKr0kugbFTf53O9L',#5,'p',$,$,$,$,(#12),#6);\n#14=IFCLOCALPLACEMENT($,#11);\n"
      "#15=IFCBUILDING('0YvctVUKr0kugbFTf53O9M',#5,'b',$,$,#14,$,$,.ELEMENT.,$,$,$);\n"
      "#16=IFCRELAGGREGATES('0YvctVUKr0kugbFTf53O9N',#5,$,$,#13,(#15));\n"
      "#17=IFCBUILDINGSTOREY('0YvctVUKr0kugbFTf53O9R',#5,'First floor',$,$,#14,$,$,.ELEMENT.,0.);\n"
      "#18=IFCRELAGGREGATES('0YvctVUKr0kugbFTf53O9S',#5,$,$,#15,(#17));\n"
      "#19=IFCRELCONTAINEDINSPATIALSTRUCTURE('0YvctVUKr0kugbFTf53O9Q',#5,$,$,({}),#17);\n"
      "#20=IFCCARTESIANPOINT((0.,0.));\n#21=IFCDIRECTION((1.,0.));\n#22=IFCAXIS2PLACEMENT2D(#20,#21);\n"
      "{}ENDSEC;\nEND-ISO-10303-21;\n",
      schema, unit, unit.empty() ? "" : "#7", contained, elements);
}

/// An element whose body is the item: numbers from so many on.
inline std::string element(int number, std::string_view item, std::string_view kind = "IFCWALL",
                           std::string_view placement = "#14") {
  return fmt::format(
      "#{0}={1}('0YvctVUKr0kugbFTf5{0}',#5,'Wall {0}',$,$,{2},#{4},$,$);\n"
      "#{3}=IFCSHAPEREPRESENTATION(#12,'Body','Any',({5}));\n#{4}=IFCPRODUCTDEFINITIONSHAPE($,$,(#{3}));\n",
      number, kind, placement, number + 1, number + 2, item);
}

/// A block of x by y around the origin, so high: takes two numbers.
inline std::string block(int number, double x, double y, double z) {
  return fmt::format(
      "#{}=IFCRECTANGLEPROFILEDEF(.AREA.,$,#22,{:.4f},{:.4f});\n#{}=IFCEXTRUDEDAREASOLID(#{},#11,#9,{:.4f});"
      "\n",
      number + 1, x, y, number, number + 1, z);
}

/// A placement at a point of the one of the storey: takes three numbers.
inline std::string placed_at(int number, double x, double y, double z) {
  return fmt::format(
      "#{}=IFCLOCALPLACEMENT(#14,#{});\n#{}=IFCAXIS2PLACEMENT3D(#{},#9,#10);\n"
      "#{}=IFCCARTESIANPOINT(({:.4f},{:.4f},{:.4f}));\n",
      number, number + 1, number + 1, number + 2, number + 2, x, y, z);
}

}  // namespace triptych::test
