// How large a model is: boxes of what is shown at full detail.
#pragma once

#include "scene/box.hpp"
#include "scene/skeleton.hpp"

#include <vector>

namespace triptych {

class HiddenObjects;

/// For each scene node the box of all that it shows at full detail, model units. SceneNode::box holds all
/// levels, which may reach further, by less than their errors. What is placed turned counts as its box does,
/// within the scene node's. Without what is hidden, if anything is; empty where all is. Looks at every
/// placement of a leaf: to be asked once.
std::vector<Box> finest_boxes(const Skeleton& skeleton, const HiddenObjects* hidden = nullptr);

/// The same of one placement of a leaf, counted from its drawables' first one.
Box placement_box(const Skeleton& skeleton, SceneNodeId leaf, uint32_t placement);

/// The one of the root; empty for a skeleton without scene nodes.
Box model_box(const Skeleton& skeleton, const HiddenObjects* hidden = nullptr);

}  // namespace triptych
