#include "samples/surfaces/polygoniser.hpp"

#include "base/progress.hpp"
#include "base/threads.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace triptych {
namespace {

using Face = std::array<uint32_t, 3>;

/// An edge of the subdivision runs from a corner of a cube to another that lies in the direction `along`: a
/// set of axes, x 1, y 2, z 4. Each grid point owns the seven edges that start at it.
struct CubeEdge {
  uint8_t corner, along;
};
using CubeTriangle = std::array<CubeEdge, 3>;

/// Triangles for each of the 256 sets of inside corners, from the six tetrahedra around the cube's diagonal.
std::array<std::vector<CubeTriangle>, 256> make_cases() {
  constexpr int ways[6][3] = {{1, 2, 4}, {2, 4, 1}, {4, 1, 2}, {1, 4, 2}, {4, 2, 1}, {2, 1, 4}};
  // Each row an even permutation of the tetrahedron's corners; the inside ones come first.
  constexpr int ones[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
  constexpr int pairs[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                               {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
  std::array<std::vector<CubeTriangle>, 256> cases;
  for (unsigned code = 0; code < 256; ++code) {
    for (int way = 0; way < 6; ++way) {
      const bool mirrored = way >= 3;
      int corner[4] = {0, ways[way][0], ways[way][0] + ways[way][1], 7};
      const auto inside = [&](int i) { return (code >> corner[i] & 1u) != 0; };
      const auto edge = [&](int a, int b) {
        const int low = std::min(corner[a], corner[b]), high = std::max(corner[a], corner[b]);
        return CubeEdge{static_cast<uint8_t>(low), static_cast<uint8_t>(high - low)};
      };
      const auto add = [&](CubeEdge a, CubeEdge b, CubeEdge c, bool turned) {
        if (turned) std::swap(b, c);
        cases[code].push_back({a, b, c});
      };
      const int count = inside(0) + inside(1) + inside(2) + inside(3);
      if (count == 1 || count == 3) {
        for (const auto& p : ones)
          if (inside(p[0]) == (count == 1))
            add(edge(p[0], p[1]), edge(p[0], p[2]), edge(p[0], p[3]), mirrored != (count == 3));
      } else if (count == 2) {
        for (const auto& p : pairs) {
          if (!inside(p[0]) || !inside(p[1])) continue;
          add(edge(p[0], p[2]), edge(p[0], p[3]), edge(p[1], p[3]), mirrored);
          add(edge(p[0], p[2]), edge(p[1], p[3]), edge(p[1], p[2]), mirrored);
        }
      }
    }
  }
  return cases;
}

const std::array<std::vector<CubeTriangle>, 256>& cases() {
  static const auto made = make_cases();
  return made;
}

/// One slice across y: values, and for each point which of its edges have a vertex and the first one's
/// number.
struct Slice {
  std::vector<float> values;
  std::vector<uint8_t> edges;
  std::vector<uint32_t> first;
};

/// Values along a row of cubes: at its low and high, near and far edges.
struct CubeRow {
  std::span<const float> near_low, near_high, far_low, far_high;
};

/// Calls visit(i, triangles) for each cube of the row that the surface goes through.
template <typename Visit>
void each_cut_cube(const CubeRow& row, const Visit& visit) {
  const auto column = [&](size_t i) {
    return static_cast<unsigned>(row.near_low[i] < 0) | static_cast<unsigned>(row.near_high[i] < 0) << 2 |
           static_cast<unsigned>(row.far_low[i] < 0) << 4 | static_cast<unsigned>(row.far_high[i] < 0) << 6;
  };
  unsigned left = column(0);
  for (size_t i = 0; i + 1 < row.near_low.size(); ++i) {
    const unsigned right = column(i + 1), code = left | right << 1;
    left = right;
    if (code != 0 && code != 255) visit(i, cases()[code]);
  }
}

void evaluate_row(const Field& field, const CubeGrid& grid, size_t k, size_t j, std::span<float> values) {
  field.evaluate({grid.low.x, grid.low.y + static_cast<double>(k) * grid.step,
                  grid.low.z + static_cast<double>(j) * grid.step, grid.step},
                 values);
}

class Sweep {
 public:
  Sweep(const Field& field, const CubeGrid& grid)
      : field_(field), grid_(grid), width_(grid.points[0]), depth_(grid.points[2]) {}

  void run(PlyWriter& writer) {
    const size_t height = grid_.points[1];
    for (Slice& slice : slices_) {
      slice.edges.resize(width_ * depth_);
      slice.first.resize(width_ * depth_);
    }
    Progress progress("making the surface", height - 1);
    evaluate(0, slices_[0]);
    evaluate(1, slices_[1]);
    number(0, slices_[0], &slices_[1], writer);
    for (size_t k = 0; k + 1 < height; ++k) {
      Slice &low = slices_[k % 3], &high = slices_[(k + 1) % 3], &next = slices_[(k + 2) % 3];
      const bool more = k + 2 < height;
      if (more) evaluate(k + 2, next);
      number(k + 1, high, more ? &next : nullptr, writer);
      connect(low, high, writer);
      progress.advance();
    }
  }

 private:
  void evaluate(size_t k, Slice& slice) {
    slice.values.resize(width_ * depth_);
    parallel_for(depth_, [&](size_t j) {
      evaluate_row(field_, grid_, k, j, std::span(slice.values).subspan(j * width_, width_));
    });
  }

  /// Finds the vertices on edges that start in this slice, numbers them row after row, and writes them.
  void number(size_t k, Slice& slice, const Slice* above, PlyWriter& writer) {
    vertices_.resize(depth_);
    parallel_for(depth_, [&](size_t j) {
      std::vector<glm::vec3>& vertices = vertices_[j];
      vertices.clear();
      for (size_t i = 0; i < width_; ++i) {
        const size_t at = j * width_ + i;
        const float value = slice.values[at];
        unsigned edges = 0;
        slice.first[at] = static_cast<uint32_t>(vertices.size());
        for (unsigned along = 1; along < 8; ++along) {
          const unsigned x = along & 1u, y = along >> 1 & 1u, z = along >> 2 & 1u;
          if (i + x >= width_ || j + z >= depth_ || (y && !above)) continue;
          const float other = (y ? above->values : slice.values)[at + x + z * width_];
          if ((value < 0) == (other < 0)) continue;
          edges |= 1u << (along - 1);
          // Away from the ends, so that vertices of neighbouring edges never fall on one place.
          const double share = std::clamp<double>(value / (value - other), 0.03, 0.97);
          const glm::dvec3 place(static_cast<double>(i) + x * share, static_cast<double>(k) + y * share,
                                 static_cast<double>(j) + z * share);
          vertices.emplace_back(grid_.low + grid_.step * place);
        }
        slice.edges[at] = static_cast<uint8_t>(edges);
      }
    });
    std::vector<uint32_t> starts;
    for (const auto& vertices : vertices_) {
      starts.push_back(static_cast<uint32_t>(writer.vertices()));
      writer.add_vertices(vertices);
    }
    parallel_for(depth_, [&](size_t j) {
      for (size_t i = 0; i < width_; ++i) slice.first[j * width_ + i] += starts[j];
    });
  }

  void connect(const Slice& low, const Slice& high, PlyWriter& writer) {
    faces_.resize(depth_ - 1);
    parallel_for(depth_ - 1, [&](size_t j) {
      std::vector<Face>& faces = faces_[j];
      faces.clear();
      const auto row = [&](const Slice& slice, size_t at) {
        return std::span<const float>(slice.values).subspan(at * width_, width_);
      };
      const CubeRow cubes{row(low, j), row(high, j), row(low, j + 1), row(high, j + 1)};
      each_cut_cube(cubes, [&](size_t i, const std::vector<CubeTriangle>& triangles) {
        const auto vertex = [&](CubeEdge edge) {
          const Slice& slice = edge.corner & 2 ? high : low;
          const size_t at = (j + (edge.corner >> 2 & 1u)) * width_ + i + (edge.corner & 1u);
          const unsigned before = slice.edges[at] & ((1u << (edge.along - 1)) - 1);
          return slice.first[at] + static_cast<uint32_t>(std::popcount(before));
        };
        for (const CubeTriangle& t : triangles) faces.push_back({vertex(t[0]), vertex(t[1]), vertex(t[2])});
      });
    });
    for (const auto& faces : faces_) writer.add_faces(faces);
  }

  const Field& field_;
  const CubeGrid& grid_;
  size_t width_, depth_;
  std::array<Slice, 3> slices_;
  std::vector<std::vector<glm::vec3>> vertices_;  // by row
  std::vector<std::vector<Face>> faces_;
};

}  // namespace

CubeGrid CubeGrid::over(const glm::dvec3& low, const glm::dvec3& high, size_t cells) {
  const glm::dvec3 size = high - low;
  CubeGrid grid{low, std::max({size.x, size.y, size.z}) / static_cast<double>(cells), {}};
  for (int axis = 0; axis < 3; ++axis) {
    const double count = std::ceil(size[axis] / grid.step - 1e-6);
    grid.points[static_cast<size_t>(axis)] = static_cast<size_t>(std::max(count, 1.0)) + 1;
  }
  return grid;
}

glm::dvec3 CubeGrid::high() const { return low + step * (glm::dvec3(points[0], points[1], points[2]) - 1.0); }

void polygonise(const Field& field, const CubeGrid& grid, PlyWriter& writer) {
  Sweep(field, grid).run(writer);
}

double estimate_triangles(const Field& field, const CubeGrid& grid, size_t rows) {
  const size_t width = grid.points[0], slabs = grid.points[1] - 1, depth = grid.points[2] - 1;
  const size_t stride = std::max<size_t>(1, slabs * depth / std::max<size_t>(rows, 1));
  std::vector<uint64_t> counts(slabs), samples(slabs);
  parallel_for(slabs, [&](size_t k) {
    std::array<std::vector<float>, 4> values;
    for (auto& row : values) row.resize(width);
    // Each slab begins elsewhere, so that no face along an axis is missed or met too often.
    for (size_t j = k * 13 % stride; j < depth; j += stride, ++samples[k]) {
      for (size_t i = 0; i < 4; ++i) evaluate_row(field, grid, k + (i & 1), j + (i >> 1), values[i]);
      each_cut_cube({values[0], values[1], values[2], values[3]},
                    [&](size_t, const auto& triangles) { counts[k] += triangles.size(); });
    }
  });
  const auto count = std::accumulate(counts.begin(), counts.end(), uint64_t{0});
  const auto sampled = std::accumulate(samples.begin(), samples.end(), uint64_t{0});
  return static_cast<double>(count) * static_cast<double>(slabs * depth) /
         static_cast<double>(std::max<uint64_t>(sampled, 1));
}

SurfaceReport write_surface(const FieldMaker& make_field, const glm::dvec3& low, const glm::dvec3& high,
                            uint64_t triangles, const std::filesystem::path& folder,
                            const std::string& name) {
  const auto wanted = static_cast<double>(triangles);
  constexpr size_t min_cells = 8, sampled_rows = 20'000;
  const auto rounded = [&](double cells) {
    return std::max(min_cells, static_cast<size_t>(std::lround(cells)));
  };
  struct Trial {
    double cells, triangles;
  };
  Trial few{0, 0}, many{0, 0};  // the nearest on either side
  size_t cells = rounded(std::sqrt(wanted / 20)), chosen = cells;
  double best = HUGE_VAL;
  constexpr int rounds = 10;
  for (int round = 0; round < rounds; ++round) {
    const CubeGrid grid = CubeGrid::over(low, high, cells);
    const double found = std::max(estimate_triangles(*make_field(grid.step), grid, sampled_rows), 1.0);
    if (const double off = std::abs(std::log(found / wanted)); off < best) {
      best = off;
      chosen = cells;
    }
    (found < wanted ? few : many) = {static_cast<double>(cells), found};
    // A smooth surface has as many triangles as the square of the cells; one that shows more details in a
    // finer grid has more: between two trials, whatever power they give.
    double better = static_cast<double>(cells) * std::clamp(std::sqrt(wanted / found), 0.25, 4.0);
    if (few.cells > 0 && many.cells > few.cells) {
      const double share = std::log(wanted / few.triangles) / std::log(many.triangles / few.triangles);
      better = few.cells * std::pow(many.cells / few.cells, std::clamp(share, 0.1, 0.9));
    }
    const size_t next = rounded(better);
    if (best < 0.02 || next == cells) break;
    cells = next;
  }
  const CubeGrid grid = CubeGrid::over(low, high, chosen);
  make_folder(folder);
  PlyWriter writer(folder / "scene.ply", name);
  polygonise(*make_field(grid.step), grid, writer);
  writer.finish();
  return {writer.vertices(), writer.faces(), grid.low, grid.high()};
}

}  // namespace triptych
