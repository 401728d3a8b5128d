#include "simplify/decimate.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <array>
#include <mutex>

#ifndef NDEBUG
#error "OpenMesh's own checks make it several times slower: this file is compiled with NDEBUG"
#endif

namespace triptych {

namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
  VertexTraits {
    uint32_t source = 0;
    OpenMesh::Geometry::QuadricT<double> quadric;
    double weight = 0;  ///< of the planes in it
  };
  FaceTraits { uint32_t color = 0; };
};
using Vector = OpenMesh::Vec3d;

/// OpenMesh's triangle mesh with two of its predicates implemented here: the library that Debian ships has
/// its own checks compiled in, and these two are evaluated for every candidate of a collapse. The results are
/// the same, except that a hub of many triangles takes no part in collapses: the predicates would cost the
/// square of their number.
class HalfEdgeMesh : public OpenMesh::TriMesh_ArrayKernelT<Traits> {
 public:
  OpenMesh::HalfedgeHandle find_halfedge(OpenMesh::VertexHandle from, OpenMesh::VertexHandle to) {
    for (auto side = halfedge_handle(from); side.is_valid();) {
      if (to_vertex_handle(side) == to) return side;
      side = next_halfedge_handle(opposite_halfedge_handle(side));
      if (side == halfedge_handle(from)) break;
    }
    return OpenMesh::HalfedgeHandle();
  }

  bool is_collapse_ok(OpenMesh::HalfedgeHandle v0v1) {
    if (status(edge_handle(v0v1)).deleted()) return false;
    const auto v1v0 = opposite_halfedge_handle(v0v1);
    const auto v0 = to_vertex_handle(v1v0), v1 = to_vertex_handle(v0v1);
    if (status(v0).deleted() || status(v1).deleted() || is_hub(v0) || is_hub(v1)) return false;
    // A triangle on either side must be connected to the rest by one of its other two edges.
    OpenMesh::VertexHandle left, right;
    for (const auto side : {v0v1, v1v0}) {
      if (is_boundary(side)) continue;
      const auto second = next_halfedge_handle(side), third = next_halfedge_handle(second);
      (side == v0v1 ? left : right) = to_vertex_handle(second);
      if (is_boundary(opposite_halfedge_handle(second)) && is_boundary(opposite_halfedge_handle(third)))
        return false;
    }
    if (left == right) return false;
    // The neighbours that both ends share are those two and no others.
    const auto first_of = [&](auto vertex) { return halfedge_handle(vertex); };
    const auto next_of = [&](auto side) { return next_halfedge_handle(opposite_halfedge_handle(side)); };
    auto side = first_of(v0);
    do status(to_vertex_handle(side)).set_tagged(false);
    while ((side = next_of(side)) != first_of(v0));
    side = first_of(v1);
    do status(to_vertex_handle(side)).set_tagged(true);
    while ((side = next_of(side)) != first_of(v1));
    side = first_of(v0);
    do {
      const auto neighbour = to_vertex_handle(side);
      if (status(neighbour).tagged() && neighbour != left && neighbour != right) return false;
    } while ((side = next_of(side)) != first_of(v0));
    // An edge between two boundary points that is not a boundary edge itself: the surface would be pinched
    // there.
    return !(is_boundary(v0) && is_boundary(v1) && !is_boundary(v0v1) && !is_boundary(v1v0));
  }

  const LayeredPlanes* planes = nullptr;  ///< of the points that vertices come from

 private:
  bool is_hub(OpenMesh::VertexHandle vertex) const {
    const auto first = halfedge_handle(vertex);
    auto side = first;
    for (int spokes = 0; spokes < 40; ++spokes) {
      side = next_halfedge_handle(opposite_halfedge_handle(side));
      if (side == first) return false;
    }
    return true;
  }
};

/// Squared distances from the planes of the triangles, weighted by area, as OpenMesh's ModQuadricT, but their
/// mean over the planes of the point that moves: sums would remove small parts first, however far that moves
/// the surface, and the largest distance is what matters. In addition: planes perpendicular to the surface
/// along borders and lines where colours meet, quadrics that survive the clean-up of the mesh between two
/// levels, and no collapse that flips a triangle.
template <typename MeshT>
class OutlineQuadric : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(OutlineQuadric, MeshT, OutlineQuadric);

  explicit OutlineQuadric(MeshT& mesh) : Base(mesh, false) {}

  void initialize() override {
    auto& mesh = Base::mesh();
    for (const auto vertex : mesh.vertices()) mesh.data(vertex).quadric.clear();
    for (const auto face : mesh.faces()) {
      const auto halfedge = mesh.halfedge_handle(face);
      const Vector point = mesh.point(mesh.to_vertex_handle(halfedge));
      const Vector normal = area_vector(face);
      const double doubled_area = normal.norm();
      if (!(doubled_area > 0)) continue;
      for (const auto vertex : mesh.fv_range(face))
        add(vertex, normal / doubled_area, point, doubled_area / 2);
      for (const auto side : mesh.fh_range(face)) {
        if (!outline(side)) continue;
        const auto from = mesh.from_vertex_handle(side), to = mesh.to_vertex_handle(side);
        const Vector along = mesh.point(to) - mesh.point(from);
        const Vector upright = along % normal;
        const double length = upright.norm();
        if (!(length > 0)) continue;
        add(from, upright / length, mesh.point(to), along.sqrnorm());
        add(to, upright / length, mesh.point(to), along.sqrnorm());
      }
    }
  }

  float collapse_priority(const CollapseInfo& info) override {
    auto& mesh = Base::mesh();
    // A point where colours meet moves along the line where they meet; one where several lines meet stays.
    int outlines = 0;
    bool collapses_along_outline = false;
    for (const auto side : mesh.voh_range(info.v0)) {
      if (mesh.is_boundary(side) || mesh.is_boundary(mesh.opposite_halfedge_handle(side)) || !outline(side))
        continue;
      ++outlines;
      collapses_along_outline |= side == info.v0v1;
    }
    if (outlines > 0 && !(outlines == 2 && collapses_along_outline)) return Base::ILLEGAL_COLLAPSE;
    const uint32_t from = mesh.data(info.v0).source, target = mesh.data(info.v1).source;
    if (mesh.planes->left(from, target) > 0) return Base::ILLEGAL_COLLAPSE;
    for (const auto side : mesh.voh_range(info.v0)) {
      const auto face = mesh.face_handle(side);
      if (!face.is_valid()) continue;
      const auto a = mesh.to_vertex_handle(side), b = mesh.to_vertex_handle(mesh.next_halfedge_handle(side));
      if (a == info.v1 || b == info.v1) continue;
      if (mesh.planes->entered(from, target, mesh.data(a).source, mesh.data(b).source) > 0)
        return Base::ILLEGAL_COLLAPSE;
      const Vector before = (mesh.point(a) - info.p0) % (mesh.point(b) - info.p0);
      const Vector after = (mesh.point(a) - info.p1) % (mesh.point(b) - info.p1);
      // At least 0.2 as the cosine: triangles that are turned on edge would look like tears, and triangles
      // must have an area.
      if (!((before | after) > 0.2 * before.norm() * after.norm())) return Base::ILLEGAL_COLLAPSE;
    }
    const auto& moved = mesh.data(info.v0);
    const double error = std::max(moved.quadric(info.p1), 0.0) / std::max(moved.weight, 1e-300);
    // Of collapses without an error (flat regions) the short ones come first, which keeps triangles well
    // shaped.
    return static_cast<float>(error + 1e-9 * (info.p1 - info.p0).sqrnorm());
  }

  void postprocess_collapse(const CollapseInfo& info) override {
    auto& mesh = Base::mesh();
    mesh.data(info.v1).quadric += mesh.data(info.v0).quadric;
    mesh.data(info.v1).weight += mesh.data(info.v0).weight;
  }

 private:
  Vector area_vector(OpenMesh::FaceHandle face) const {
    auto& mesh = const_cast<OutlineQuadric*>(this)->mesh();
    const auto halfedge = mesh.halfedge_handle(face);
    const Vector a = mesh.point(mesh.from_vertex_handle(halfedge)),
                 b = mesh.point(mesh.to_vertex_handle(halfedge));
    const Vector c = mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(halfedge)));
    return (b - a) % (c - a);
  }

  bool outline(OpenMesh::HalfedgeHandle side) {
    auto& mesh = Base::mesh();
    const auto here = mesh.face_handle(side), there = mesh.face_handle(mesh.opposite_halfedge_handle(side));
    return !here.is_valid() || !there.is_valid() || mesh.data(here).color != mesh.data(there).color;
  }

  void add(OpenMesh::VertexHandle vertex, const Vector& normal, const Vector& point, double weight) {
    OpenMesh::Geometry::QuadricT<double> quadric(normal[0], normal[1], normal[2], -(normal | point));
    quadric *= weight;
    Base::mesh().data(vertex).quadric += quadric;
    Base::mesh().data(vertex).weight += weight;
  }
};

/// Adds the triangles to the mesh; one that meets the others in a way that half-edges cannot express is put
/// on another sheet with points of its own, so that it is not lost. Points where sheets meet are locked, or
/// the sheets would separate. Returns how many triangles are not on the first sheet.
size_t fill(HalfEdgeMesh& mesh, const Surface& surface, std::span<const uint8_t> locked) {
  constexpr size_t sheets = 4;  // beyond that each triangle is a sheet of its own
  const glm::ivec3 origin = surface.points[0];
  const auto add_vertex = [&](uint32_t point) {
    const glm::dvec3 position = glm::dvec3(surface.points[point]) - glm::dvec3(origin);
    const auto vertex = mesh.add_vertex({position.x, position.y, position.z});
    mesh.data(vertex).source = point;
    if (!locked.empty() && locked[point]) mesh.status(vertex).set_locked(true);
    return vertex;
  };
  mesh.reserve(surface.points.size(), surface.triangles.size() * 3 / 2, surface.triangles.size());
  std::vector<uint32_t> waiting(surface.triangles.size()), refused;
  for (uint32_t i = 0; i < waiting.size(); ++i) waiting[i] = i;
  size_t detached = 0;
  std::vector<HalfEdgeMesh::VertexHandle> first(surface.points.size());
  for (size_t sheet = 0; !waiting.empty(); ++sheet) {
    std::vector<HalfEdgeMesh::VertexHandle> vertices(surface.points.size());
    refused.clear();
    for (const uint32_t index : waiting) {
      const Triangle& triangle = surface.triangles[index];
      std::array<HalfEdgeMesh::VertexHandle, 3> corners;
      for (size_t i = 0; i < 3; ++i) {
        auto& vertex = vertices[triangle.vertices[i]];
        if (!vertex.is_valid() || sheet >= sheets) vertex = add_vertex(triangle.vertices[i]);
        corners[i] = vertex;
      }
      const auto face = mesh.add_face(corners[0], corners[1], corners[2]);
      if (face.is_valid()) {
        mesh.data(face).color = triangle.material;
        for (size_t i = 0; i < 3; ++i) {
          auto& meets = first[triangle.vertices[i]];
          if (!meets.is_valid()) meets = corners[i];
          if (meets == corners[i]) continue;
          mesh.status(meets).set_locked(true);
          mesh.status(corners[i]).set_locked(true);
        }
      } else {
        refused.push_back(index);
      }
    }
    if (sheet == 0) detached = refused.size();
    std::swap(waiting, refused);
  }
  mesh.delete_isolated_vertices();
  mesh.garbage_collection();
  return detached;
}

/// OpenMesh writes each refused face to standard error; we count them.
void silence_open_mesh() {
  static std::once_flag once;
  std::call_once(once, [] { omerr().disable(); });
}

}  // namespace

struct Decimation::State {
  State(const Surface& surface, std::span<const uint8_t> locked, const LayeredPlanes& planes)
      : origin(surface.points[0]), detached(fill(mesh, surface, locked)), decimater(mesh) {
    mesh.planes = &planes;
    OpenMesh::Decimater::ModHandleT<OutlineQuadric<HalfEdgeMesh>> module;
    decimater.add(module);
    decimater.initialize();
  }
  HalfEdgeMesh mesh;
  glm::ivec3 origin;
  size_t detached;
  OpenMesh::Decimater::DecimaterT<HalfEdgeMesh> decimater;
};

Decimation::Decimation(const Surface& surface, std::span<const uint8_t> locked, const LayeredPlanes& planes) {
  silence_open_mesh();
  state_ = std::make_unique<State>(surface, locked, planes);
}
Decimation::~Decimation() = default;

size_t Decimation::detached_triangles() const { return state_->detached; }

Piece Decimation::reduce_to(size_t triangles) {
  auto& mesh = state_->mesh;
  state_->decimater.decimate_to_faces(0, triangles);
  mesh.garbage_collection();
  Piece piece;
  // Merges the points of different sheets again.
  std::vector<std::pair<uint32_t, uint32_t>> found;
  for (const auto vertex : mesh.vertices())
    found.push_back({mesh.data(vertex).source, static_cast<uint32_t>(vertex.idx())});
  std::sort(found.begin(), found.end());
  std::vector<uint32_t> place(mesh.n_vertices());
  for (const auto& [source, vertex] : found) {
    if (piece.sources.empty() || piece.sources.back() != source) {
      const Vector point = mesh.point(HalfEdgeMesh::VertexHandle(static_cast<int>(vertex)));
      piece.sources.push_back(source);
      piece.surface.points.push_back(state_->origin + glm::ivec3(glm::dvec3(point[0], point[1], point[2])));
    }
    place[vertex] = static_cast<uint32_t>(piece.sources.size() - 1);
  }
  for (const auto face : mesh.faces()) {
    Triangle triangle{{}, mesh.data(face).color};
    size_t corner = 0;
    for (const auto vertex : mesh.fv_range(face))
      triangle.vertices[corner++] = place[static_cast<size_t>(vertex.idx())];
    piece.surface.triangles.push_back(triangle);
  }
  return piece;
}

}  // namespace triptych
