#include "tests/hard_cases/stress.hpp"

#include "base/clock.hpp"
#include "tests/hard_cases/maker.hpp"
#include "tests/hard_cases/trials.hpp"
#include "tests/support/test_device.hpp"

#include <array>
#include <cmath>
#include <fmt/core.h>
#include <glm/gtc/constants.hpp>

namespace triptych::hard_cases {

namespace {

class RandomTrial {
 public:
  explicit RandomTrial(uint32_t seed) : random_(seed) {}

  Trial make() {
    const int kinds = 1 + static_cast<int>(random_.index(3));
    for (int i = 0; i < kinds; ++i) add_objects();
    Trial trial;
    trial.model = maker_.model();
    trial.slivers = trial.may_be_empty = true;
    const uint32_t triangles = 8u << random_.index(6);
    trial.build = {.part_triangles = triangles,
                   .leaf_triangles = triangles,
                   .hlod_triangles = 16u << random_.index(4),
                   .hierarchy = random_.index(4) == 0 ? HierarchyKind::median_split
                                                      : HierarchyKind::partition_cluster_partition};
    trial.pixel_error = std::exp2(random_.number(-3, 4));
    add_views(trial);
    const std::vector<SectionPlane> planes = random_planes();
    const double scale = random_.index(3) == 0 ? std::exp2(std::floor(random_.number(-40, 40))) : 1;
    const glm::dvec3 place =
        random_.index(3) == 0 ? random_.vector(-1, 1) * std::exp2(random_.number(0, 24)) : glm::dvec3(0);
    trial.model = scaled(moved(std::move(trial.model), place), scale);
    trial.views = scaled(moved(std::move(trial.views), place), scale);
    for (const SectionPlane& plane : planes) {
      Section& section = trial.sections.emplace_back();
      section.add_plane({plane.normal, scale * (plane.offset + glm::dot(plane.normal, place))}, "stress");
      if (random_.index(3) == 0)
        section.add_plane({-plane.normal, -section.planes()[0].offset - 2 * scale}, "stress");
    }
    return trial;
  }

 private:
  void add_objects() {
    const int count = 1 + static_cast<int>(random_.index(80));
    const double size = std::exp2(random_.number(-6, 2));
    switch (random_.index(7)) {
      case 0:
        maker_.clutter(count, glm::dvec3(-4), glm::dvec3(4), size, random_.index(1000));
        break;
      case 1:
        for (int i = 0; i < count; ++i) flat_box(size);
        break;
      case 2:
        for (int i = 0; i < 1 + count / 12; ++i)
          maker_.mesh(awkward::sphere(4 + random_.index(9), size),
                      awkward::translation(random_.vector(-4, 4)));
        break;
      case 3:
        maker_.mesh(awkward::soup(1 + random_.index(300), random_.index(1000)),
                    awkward::translation(glm::dvec3(-5)));
        break;
      case 4:
        maker_.mesh(awkward::sphere(4 + random_.index(6), 1), placement(size));
        for (int i = 0; i < count; ++i) maker_.place(placement(size));
        break;
      case 5:
        for (int i = 0; i < count; ++i) {
          const glm::dvec3 at = random_.vector(-4, 4), along = random_.vector(-1, 1);
          maker_.triangle(at, at + along * random_.number(0.1, 4),
                          at + along * random_.number(0.1, 4) +
                              random_.vector(-1, 1) * std::exp2(-random_.number(2, 20)));
        }
        break;
      default:
        for (int i = 0; i < count; ++i) {
          const glm::dvec3 corner = glm::floor(random_.vector(-4, 4));
          maker_.box(corner, corner + glm::ceil(random_.vector(0, 2)));
        }
    }
  }

  /// For half of the trials none.
  std::vector<SectionPlane> random_planes() {
    std::vector<SectionPlane> planes;
    for (uint32_t count = random_.index(2) * random_.index(6); count > 0; --count) {
      const glm::dvec3 normal = glm::normalize(random_.vector(-1, 1) + glm::dvec3(0, 0, 1e-3));
      planes.push_back({normal, glm::dot(normal, random_.vector(-4, 4))});
    }
    return planes;
  }

  void flat_box(double size) {
    const glm::dvec3 lo = random_.vector(-4, 4);
    glm::dvec3 extent = random_.vector(0.1, 4 * size);
    extent[static_cast<int>(random_.index(3))] = 0;
    maker_.box(lo, lo + extent);
  }

  Affine placement(double size) {
    const glm::dvec3 axis = glm::normalize(random_.vector(-1, 1) + glm::dvec3(0, 0, 1e-3));
    glm::dmat3 turned = glm::dmat3(glm::rotate(glm::dmat4(1), random_.number(0, 6.28), axis)) * size;
    turned[0] *= (random_.index(2) == 0 ? -1 : 1) * std::exp2(random_.number(-4, 2));
    if (random_.index(4) == 0) turned[1] = turned[0] + turned[1] * std::exp2(-random_.number(0, 20));
    return linear(turned[0], turned[1], turned[2], random_.vector(-4, 4));
  }

  void add_views(Trial& trial) {
    constexpr std::array<Size, 6> sizes = {Size{96, 72}, Size{64, 64},  Size{253, 61},
                                           Size{1, 1},   Size{16, 320}, Size{200, 151}};
    const Size size = sizes[random_.index(sizes.size())];
    glm::dvec3 eye = random_.vector(-6, 6), target = random_.vector(-4, 4);
    for (int i = 0; i < 12; ++i) {
      if (random_.index(3) == 0) eye = random_.vector(-6, 6) * (random_.index(6) == 0 ? 200.0 : 1.0);
      if (random_.index(8) == 0) eye = glm::floor(eye);
      if (random_.index(2) == 0) target = random_.vector(-4, 4);
      eye += random_.vector(-0.1, 0.1);
      const glm::dvec3 up = random_.index(3) == 0 ? random_.vector(-1, 1) : glm::dvec3(0, 0, 1);
      if (glm::length(glm::cross(glm::normalize(target - eye), up)) < 1e-6) continue;
      View view =
          look(eye, target, std::exp2(random_.number(-2, 7.4)), size, std::exp2(random_.number(-14, 1)), up);
      if (random_.index(5) == 0) {
        set_orthographic_height(view.camera, std::exp2(random_.number(-4, 4)),
                                double(size.width) / size.height);
      } else if (random_.index(4) == 0) {
        view.camera.left += 0.7 * view.camera.right;
        view.camera.top *= 2.5;
      }
      trial.views.push_back(view);
    }
    if (trial.views.empty()) trial.views.push_back(look({9, 8, 7}, {0, 0, 0}, 60, size));
  }

  Random random_;
  Maker maker_;
};

}  // namespace

Trial random_trial(uint32_t seed) { return RandomTrial(seed).make(); }

int run_stress(double minutes, uint32_t first_seed) {
  const Stopwatch stopwatch;
  int failed = 0;
  uint32_t seed = first_seed;
  uint64_t frames = 0;
  for (; stopwatch.seconds() < minutes * 60; ++seed) {
    const Trial trial = random_trial(seed);
    Problems problems;
    try {
      problems = build_problems(trial);
      for (const Problems& more : {cut_problems(trial), picture_problems(trial, test::device())})
        problems.insert(problems.end(), more.begin(), more.end());
    } catch (const std::exception& error) {
      problems.push_back(error.what());
    }
    frames += trial.views.size();
    for (const std::string& problem : problems) fmt::print("seed {}: {}\n", seed, problem);
    std::fflush(stdout);
    failed += !problems.empty();
  }
  fmt::print("seeds {} to {}: {} frames in {:.0f} s, {} of {} scenes failed\n", first_seed, seed - 1, frames,
             stopwatch.seconds(), failed, seed - first_seed);
  return failed;
}

}  // namespace triptych::hard_cases
