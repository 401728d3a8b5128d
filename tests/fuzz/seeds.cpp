// Writes a few small, whole files for each fuzz target: seeds FOLDER makes FOLDER/gltf, FOLDER/obj and so on.
#include "base/bytes.hpp"
#include "base/descriptor.hpp"
#include "base/file.hpp"
#include "model/import/scene_writer.hpp"
#include "preprocess/encode_chunk.hpp"
#include "preprocess/encode_objects.hpp"
#include "preprocess/pack_writer.hpp"
#include "preprocess/triangle_objects.hpp"
#include "scene/pack.hpp"
#include "scene/pack_skeleton.hpp"
#include "wire_seeds.hpp"

#include <array>
#include <cstdio>
#include <fcntl.h>
#include <fstream>

namespace triptych {

namespace {

std::filesystem::path folder;

void write(const std::string& name, std::span<const std::byte> bytes) {
  make_folder((folder / name).parent_path());
  std::ofstream(folder / name, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}
void write(const std::string& name, std::string_view text) { write(name, std::as_bytes(std::span(text))); }

void write_gltf() {
  const std::string rest =
      R"("bufferViews":[{"buffer":0,"byteLength":48,"byteStride":12},{"buffer":0,"byteOffset":48,"byteLength":12}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":1,"indices":{"bufferView":1,
"componentType":5121},"values":{"bufferView":0}}},{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"},
{"bufferView":0,"componentType":5122,"count":4,"type":"VEC3","normalized":true},
{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,0.75]},"alphaMode":"BLEND"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},
{"primitives":[{"attributes":{"POSITION":2,"COLOR_0":3},"mode":5},{"attributes":{"POSITION":3},"indices":1,"mode":6}]}],
"nodes":[{"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1],"children":[1]},{"mesh":1,"rotation":[0,0,0,1],
"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":3}}}}],"scenes":[{"nodes":[0]}],"scene":0})";
  const std::string data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8AAAAAAAABAAIAAgABAAMA";
  write(
      "gltf/embedded.gltf",
      R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,)" +
          data + "\"}]," + rest);
  std::string json = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":60}],)" + rest;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  ByteWriter glb;
  glb.write_all(std::span<const char>(std::string("glTF")));
  glb.write(2u);
  glb.write(static_cast<uint32_t>(28 + json.size() + 60));
  glb.write(static_cast<uint32_t>(json.size()));
  glb.write_all(std::span<const char>(std::string("JSON") + json));
  glb.write(60u);
  glb.write(0x004e4942u);
  for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f}) glb.write(value);
  for (const uint16_t value : std::to_array<uint16_t>({0, 1, 2, 2, 1, 3})) glb.write(value);
  write("gltf/binary.glb", glb.bytes());
}

void write_text_formats() {
  write("obj/square.obj",
        "mtllib 0\no a\nv 0 0 0\nv 4 0 0 1 0 0\nv 1 1 0\nv 0 4 1e3\nvt 0 0\nusemtl red\nf 1/1/1 2//1 3/1 "
        "4\ng b\nf -1 -2 "
        "-3\nf 1 2 \\\n 3\nl 1 2\nnewmtl red\nKd 1 0 0\nd 0.5\n");
  const std::string header =
      " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face "
      "2\nproperty list "
      "uchar int vertex_indices\nend_header\n";
  write("ply/ascii.ply", "ply\nformat ascii" + header + "0 0 0\n4 0 0\n1 1 0\n0 4 0\n4 0 1 2 3\n3 0 1 2\n");
  write("ply/faces.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
        "z\nelement face "
        "1\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar "
        "blue\nend_header\n0 0 0\n4 0 0\n1 1 0\n3 0 1 2 9 200 0\n");
  ByteWriter ply;
  ply.write_all(std::span<const char>("ply\nformat binary_little_endian" + header));
  for (const float value : {0.f, 0.f, 0.f, 4.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 4.f, 0.f}) ply.write(value);
  ply.write(uint8_t{4});
  for (const int32_t value : {0, 1, 2, 3}) ply.write(value);
  ply.write(uint8_t{3});
  for (const int32_t value : {0, 1, 2}) ply.write(value);
  write("ply/binary.ply", ply.bytes());
  write("ply/colors.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property uchar red\nproperty uchar green\nproperty float blue\nelement face 1\nproperty list uchar "
        "int "
        "vertex_indices\nend_header\n0 0 0 255 0 0.5\n4 0 0 0 9 1\n1 1 0 3 0 nan\n3 0 1 2\n");
  write("ply/normals.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty double ny\nproperty char nz\nelement face 1\nproperty list uchar int "
        "vertex_indices\nend_header\n0 0 0 0 0 1\n4 0 0 0.3 1e300 1\n1 1 0 nan 0 1\n3 0 1 2\n");
  ByteWriter mixed;
  mixed.write_all(
      std::span<const char>(std::string("ply\nformat binary_big_endian 1.0\nelement face 1\nproperty list "
                                        "uchar uchar vertex_index\nproperty list char "
                                        "double w\nelement vertex 3\nproperty list uchar uchar l\nproperty "
                                        "char x\nproperty uchar y\nproperty short z\n"
                                        "end_header\n")));
  for (const uint8_t value :
       std::to_array<uint8_t>({3, 0, 1, 2, 0, 0, 1, 2, 0, 3, 0, 4, 5, 0, 6, 1, 9, 7, 8, 0, 9}))
    mixed.write(value);
  write("ply/mixed.ply", mixed.bytes());
  write("stl/ascii.stl",
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
        "1e9\nendloop\nendfacet\n"
        "endsolid a\n");
  write("dxf/insert.dxf",
        "0\nSECTION\n2\nTABLES\n0\nLAYER\n2\nA\n62\n-"
        "1\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nT\n0\n3DFACE\n"
        "8\nA\n10\n0\n20\n0\n11\n1\n12\n0\n22\n1\n0\nENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nINSERT\n2"
        "\nT\n"
        "50\n30\n70\n2\n44\n3\n0\nPOLYLINE\n70\n64\n0\nVERTEX\n70\n192\n10\n1\n0\nVERTEX\n70\n128\n71\n1\n0\n"
        "SEQEND\n"
        "0\nLWPOLYLINE\n39\n2\n43\n1\n10\n0\n20\n0\n42\n1\n10\n4\n20\n0\n0\nMESH\n92\n1\n10\n0\n20\n0\n30\n0"
        "\n93\n1\n"
        "90\n1\n0\nENDSEC\n0\nEOF\n");
  write("3mf/empty.3mf", std::string("PK\5\6") + std::string(18, '\0'));
  ByteWriter stl;
  stl.write_all(std::span<const char>(std::string(80, 's')));
  stl.write(1u);
  for (int i = 0; i < 12; ++i) stl.write(static_cast<float>(i));
  stl.write(uint16_t{1});
  write("stl/binary.stl", stl.bytes());
}

/// The members of viewpoint files, as the target takes them.
void write_viewpoints() {
  const auto vector = [](const std::string& name, const std::string& x, const std::string& y,
                         const std::string& z) {
    return "<" + name + "><X>" + x + "</X><Y>" + y + "</Y><Z>" + z + "</Z></" + name + ">";
  };
  const std::string camera = vector("CameraViewPoint", "1.5", "-2e3", "+3") +
                             vector("CameraDirection", "0", "1", "0") +
                             vector("CameraUpVector", "0", "0", "1");
  const std::string plane = "<ClippingPlane>" + vector("Location", "1", "2", "3") +
                            vector("Direction", "0", "-0.5", "0.25") + "</ClippingPlane>";
  const std::string components =
      "<Components><Selection><Component IfcGuid=\"0123456789abcdefABCD_$\"/></Selection><Visibility "
      "DefaultVisibility=\"false\"><Exceptions><Component IfcGuid=\"a\"/></Exceptions></Visibility>"
      "<Coloring><Color/></Coloring></Components>";
  const std::string zero(1, '\0'), begin = "<?xml version=\"1.0\"?><VisualizationInfo Guid=\"v\">";
  write("bcf/2.1", "<Version VersionId=\"2.1\"/>" + zero +
                       "<Markup><Topic Guid=\"t\"><Title>A &amp; B</Title></Topic><Viewpoints Guid=\"v\">"
                       "<Viewpoint>a.bcfv</Viewpoint></Viewpoints></Markup>" +
                       zero + begin + components + "<PerspectiveCamera>" + camera +
                       "<FieldOfView>50</FieldOfView></PerspectiveCamera><ClippingPlanes>" + plane + plane +
                       "</ClippingPlanes><Lines><Line/></Lines><Bitmap/></VisualizationInfo>");
  write("bcf/3.0", "<Version VersionId=\"3.0\"/>" + zero +
                       "<Markup><Topic Guid=\"t\"><Title>A</Title><Viewpoints><ViewPoint Guid=\"v\">"
                       "<Viewpoint>a.bcfv</Viewpoint></ViewPoint></Viewpoints></Topic></Markup>" +
                       zero + begin + "<OrthogonalCamera>" + camera +
                       "<ViewToWorldScale>7</ViewToWorldScale></OrthogonalCamera></VisualizationInfo>");
}

/// What a converter writes of two triangles, placed twice.
void write_scene() {
  const auto file = folder / "scene/two";
  make_folder(file.parent_path());
  const Descriptor output(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644));
  SceneWriter writer(output.number(), file.string(), unit_is_defined);
  const uint32_t red = writer.material({1, 0, 0, 1}), glass = writer.material({0, 0, 1, 0.5f});
  const std::vector<glm::dvec3> positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.25}};
  const std::vector<uint32_t> indices = {0, 1, 2, 0, 2, 3};
  const std::vector<ScenePart> parts = {{1, red}, {1, no_record}};
  const uint32_t mesh = writer.mesh("plate", positions, indices, parts);
  const uint32_t set = writer.property_set({"Pset", {{"Key", "Value"}}});
  const uint32_t object = writer.object({.id = "#1",
                                         .name = "Plate",
                                         .guid = "2O2",
                                         .type = "IfcPlate",
                                         .storey = "1",
                                         .layer = "A",
                                         .property_sets = {set}});
  writer.instance({.mesh = mesh, .material = glass, .object = object, .transform = Affine(1)});
  Affine moved(1);
  moved[3] = {5, 0, 0};
  writer.instance({.mesh = mesh, .material = no_record, .object = no_record, .transform = moved});
  writer.end();
}

/// The skeleton's hierarchy twice in a pair, one of them mirrored, and the pair and one more in the model.
StoredSkeleton with_instances(Skeleton skeleton) {
  StoredSkeleton stored;
  Affine mirrored(1);
  mirrored[0].x = -1;
  const SceneNode inner{.box = {{-2, 0, 0}, {2, 2, 1}}, .first_child = 1, .child_count = 2};
  SceneNode instance = inner;
  instance.parent = 0;
  instance.first_child = instance.child_count = 0;
  stored.sub_hierarchies.push_back({.lattice = 0,
                                    .scene_nodes = std::move(skeleton.scene_nodes),
                                    .drawables = std::move(skeleton.drawables),
                                    .placements = std::move(skeleton.placements),
                                    .transforms = skeleton.transforms,
                                    .instances = {}});
  stored.sub_hierarchies.push_back({.lattice = 0,
                                    .scene_nodes = {inner, instance, instance},
                                    .drawables = {},
                                    .placements = {},
                                    .transforms = {Affine(1), mirrored},
                                    .instances = {{.scene_node = 1}, {.scene_node = 2, .transform = 1}}});
  stored.surrounding = std::move(skeleton);
  stored.surrounding.transforms.push_back(mirrored);
  stored.surrounding.scene_nodes = {inner, instance, instance};
  stored.surrounding.drawables.clear();
  stored.surrounding.placements.clear();
  stored.instances = {{.scene_node = 1, .sub_hierarchy = 1},
                      {.scene_node = 2, .sub_hierarchy = 0, .transform = 1}};
  return stored;
}

void write_pack() {
  Chunk chunk;
  for (int i = 0; i < 9; ++i) chunk.vertices.push_back({{i % 3, i / 3, i % 2}, i % 2 ? 1u : 0u});
  chunk.indices = {0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4, 3, 4, 6, 4, 7, 6};
  for (const uint32_t corner : {4u, 5u, 7u, 5u, 8u, 7u}) {  // a second piece
    chunk.indices.push_back(static_cast<uint32_t>(chunk.vertices.size()));
    chunk.vertices.push_back(chunk.vertices[corner]);
    chunk.vertices.back().piece = 1;
  }
  Skeleton skeleton;
  skeleton.lattices = {Lattice{{0, 0, 0}, 0.125}};
  skeleton.palette = {{200, 10, 10, 255}, {10, 200, 10, 255}};
  skeleton.transforms = {Affine(1)};
  skeleton.scene_nodes = {{.box = {{0, 0, 0}, {2, 2, 1}}, .first_drawable = 0, .drawable_count = 1}};
  skeleton.placements = {{0, 0}};
  skeleton.drawables = {
      {.error = 0, .scene_node = 0, .first_placement = 0, .placement_count = 1, .triangles = 8}};
  skeleton.source_triangles = skeleton.placed_triangles = 8;
  skeleton.import.warnings = {"a warning"};

  const auto file = folder / "whole.tpk";
  PackWriter writer(file);
  writer.add_chunk(chunk, 0);
  const PackOptions options = {{"bound", "fast"}, {"keep", "cover,touching"}};
  writer.finish({skeleton, {}, {}}, {}, options);
  ByteWriter whole;
  whole.write(uint8_t{1});
  whole.write_all(std::span<const std::byte>(read_file(file)));
  write("pack/whole", whole.bytes());
  skeleton.chunks = Pack(file).skeleton().chunks;
  skeleton.pieces = Pack(file).skeleton().pieces;
  std::filesystem::remove(file);
  {
    PackWriter instanced(file);
    instanced.add_chunk(chunk, 0);
    instanced.finish(with_instances(skeleton));
    ByteWriter instanced_whole;
    instanced_whole.write(uint8_t{1});
    instanced_whole.write_all(std::span<const std::byte>(read_file(file)));
    write("pack/whole_instances", instanced_whole.bytes());
    const Pack opened(file);  // or the seed is none
    std::filesystem::remove(file);
  }

  StoredObjects objects;
  SourceObjects& source = objects.objects;
  source.objects = {{.name = source.texts.add("Hall")},
                    {.name = source.texts.add("Wall"), .type = source.texts.add("IfcWall"), .parent = 0}};
  source.set_uses = {0};
  source.sets = {{.name = source.texts.add("Pset")}};
  source.properties = {{source.texts.add("Key"), source.texts.add("Value")}};
  HierarchyObjects& hierarchy = objects.hierarchies.emplace_back();
  hierarchy.add_leaf(0, std::vector<ObjectRun>{{1, no_id}, {2, 1}});
  hierarchy.add_drawable(1, encode_triangle_objects(std::vector<SourceObjectId>{1, 1, no_id, 0, 1}));
  ByteWriter section;
  section.write(uint8_t{3});
  section.write_all(std::span<const std::byte>(encode_objects(objects)));
  write("pack/objects", section.bytes());
  ByteWriter said;
  said.write(uint8_t{4});
  said.write_all(std::span<const std::byte>(encode_pack_options(options)));
  write("pack/options", said.bytes());

  const auto encoded = encode_chunk(chunk);
  const auto parts_of = [](uint8_t kind, const std::vector<std::byte>& first,
                           const std::vector<std::byte>& second) {
    ByteWriter parts;
    parts.write(kind);
    parts.write(static_cast<uint32_t>(first.size()));
    parts.write_all(std::span<const std::byte>(first));
    parts.write_all(std::span<const std::byte>(second));
    return std::move(parts.bytes());
  };
  write("pack/parts", parts_of(0, encode_skeleton(skeleton), encoded));
  Chunk colored = chunk;
  colored.colors.resize(colored.vertices.size(), {250, 120, 30, 255});
  const auto colored_bytes = encode_chunk(colored);
  Skeleton of_colored = skeleton;
  of_colored.chunks[0].size = colored_bytes.size();
  write("pack/colors", parts_of(0, encode_skeleton(of_colored), colored_bytes));
  Chunk shaded = colored;
  shaded.normals.resize(shaded.vertices.size(), {900, 1300});
  shaded.normals_from = ChunkNormals::of_files;
  const auto shaded_bytes = encode_chunk(shaded);
  Skeleton of_shaded = skeleton;
  of_shaded.chunks[0].size = shaded_bytes.size();
  write("pack/normals", parts_of(0, encode_skeleton(of_shaded), shaded_bytes));
  const StoredSkeleton instanced = with_instances(std::move(skeleton));
  write("pack/instances",
        parts_of(2, encode_skeleton(instanced.surrounding), encode_sub_hierarchies(instanced)));
}

}  // namespace

}  // namespace triptych

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  triptych::folder = arguments[1];
  triptych::make_folder(triptych::folder);
  triptych::write_gltf();
  triptych::write_text_formats();
  triptych::write_viewpoints();
  triptych::write_scene();
  triptych::write_pack();
  for (const auto& [name, bytes] : triptych::fuzz::wire_seeds()) triptych::write(name, bytes);
  return 0;
}
