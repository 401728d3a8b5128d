// The three processes of a session, and the two sockets between each pair of them.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace triptych {

/// The render node draws; in frame i switch node i mod 2 tests boxes, and the other builds the next occlusion
/// representation.
enum class Role : uint8_t { render, switch_0, switch_1 };
inline constexpr std::array all_roles = {Role::render, Role::switch_0, Role::switch_1};

/// `camera` carries cameras, `nodes` sets of drawables and what belongs to them, so that neither waits behind
/// the other.
enum class Channel : uint8_t { camera, nodes };
inline constexpr std::array all_channels = {Channel::camera, Channel::nodes};

/// "render node", "switch node 0", "switch node 1".
const std::string& role_name(Role role);
/// "camera channel", "nodes channel".
const std::string& channel_name(Channel channel);

/// The switch node that tests boxes in this frame (HC), and the one that draws the next occlusion
/// representation (OR).
constexpr Role hardware_cull_role(uint32_t frame) { return frame % 2 == 0 ? Role::switch_0 : Role::switch_1; }
constexpr Role occlusion_role(uint32_t frame) { return hardware_cull_role(frame + 1); }

}  // namespace triptych
