#include "nodes/picture_stage.hpp"

namespace triptych {

PictureStage::PictureStage(Renderer& renderer, int width, int height, TargetKind kind)
    : renderer_(renderer), target_(kind, width, height), kind_(kind) {}

void PictureStage::begin(const View& view) {
  renderer_.set_view(view);
  target_.clear();
  drawn_triangles_ = drawn_drawables_ = 0;
}

void PictureStage::draw(const std::vector<DrawableId>& drawables) {
  drawn_triangles_ += renderer_.draw(drawables, target_, kind_);
  drawn_drawables_ += drawables.size();
}

void PictureStage::finish() { glFinish(); }

}  // namespace triptych
