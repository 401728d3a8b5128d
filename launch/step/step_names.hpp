// What an OpenCASCADE document calls its products, their placements and their bodies.
#pragma once

#include <TCollection_ExtendedString.hxx>
#include <TDF_Label.hxx>
#include <TopoDS_Shape.hxx>
#include <XCAFPrs_DocumentNode.hxx>
#include <string>
#include <vector>

namespace triptych {

/// In UTF-8.
std::string text_of(const TCollection_ExtendedString& text);

/// Empty for names as "=>[0:1:1:3]", which OpenCASCADE gives to placements, and writes.
std::string name_of(const TDF_Label& label);
/// Of a placement, or else of what it places.
std::string name_of(const XCAFPrs_DocumentNode& node);

/// A solid or shell of a product, with a name of its own.
struct Body {
  std::string name;
  TopoDS_Shape shape;
};

/// Of a product with several: IGES has no other parts. One alone is the product.
std::vector<Body> named_bodies_of(const TDF_Label& product);

}  // namespace triptych
