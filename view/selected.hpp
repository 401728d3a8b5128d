// All that is selected, and what it comes to.
#pragma once

#include "scene/model_system.hpp"
#include "view/selection.hpp"

#include <string>
#include <vector>

namespace triptych {

/// In the order in which it was selected; each object, or of what has none each placement, once.
class Selected {
 public:
  const std::vector<Selection>& all() const { return all_; }
  bool empty() const { return all_.empty(); }
  void clear() { all_.clear(); }
  /// That alone.
  void set(Selection selection);
  void set(std::vector<Selection> selections) { all_ = std::move(selections); }
  /// Adds it, or takes it away if it is there. True where it was added.
  bool toggle(Selection selection);

  /// Around all of it, model space; empty where it shows nothing.
  Box box() const;
  /// Those that are objects.
  std::vector<SourceObjectId> objects() const;
  /// At full detail.
  uint64_t triangles() const;

  /// "Door 7", or "3 objects"; empty where nothing is selected.
  std::string name() const;
  /// Triangles and size, with the axes and unit of the model's files: "1,204 triangles, 0.900 x 0.100 x 2.100
  /// m". Without the size where it shows nothing.
  std::string sum(const ModelSystem& system) const;

 private:
  std::vector<Selection> all_;
};

}  // namespace triptych
