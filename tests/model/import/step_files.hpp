// Small STEP and IGES files, written by OpenCASCADE.
#pragma once

#include <filesystem>
#include <string>

namespace triptych::test {

/// A blue block of 10 x 20 x 30 mm, z up, whose top is red, three times along x, each 100 mm from the last;
/// and twice a part without a colour of its own, the second time in green. Names: "Frame", "Block", "Plate".
void write_step_assembly(const std::filesystem::path& file, const std::string& schema);

/// Two parts within an assembly that is placed twice along x: one has no colour, the other is blue. The
/// second placement of the assembly is green.
void write_step_coloured_assembly(const std::filesystem::path& file);

/// A cylinder of radius 50 and height 100 units around z.
void write_step_cylinder(const std::filesystem::path& file, const std::string& unit);

/// A group "Pair" of two parts within a group "Whole": "Left", a red cube of 10 mm, and "Right", a blue one
/// 20 mm along x; and a third, green cube beside, 40 mm along x, whose name is `third`.
void write_iges_groups(const std::filesystem::path& file, const std::string& third);

/// A block of 10 x 20 x 30 units.
void write_iges_block(const std::filesystem::path& file, const std::string& unit);

}  // namespace triptych::test
