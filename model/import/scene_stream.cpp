#include "model/import/scene_stream.hpp"

#include <cstring>
#include <numeric>

namespace triptych {

namespace {

/// The records of a stream from front to back, and how many of each kind there were.
class Reader {
 public:
  Reader(const std::shared_ptr<const StreamSource>& source, SceneSink& sink)
      : window_(source, 0, source->size()), sink_(sink) {}

  void run() {
    if (window_.left() < 16 || std::memcmp(window_.take(8), scene_stream_magic.data(), 8) != 0)
      fail(window_.place(), "its reader wrote no scene");
    if (const auto version = value<uint32_t>(); version != scene_stream_version)
      fail(window_.place(), "its reader wrote version {} of a scene, not {}", version, scene_stream_version);
    const auto defined = value<uint32_t>();
    sink_.begin((defined & unit_is_defined) != 0, (defined & axes_are_defined) != 0);
    while (next()) {
    }
  }

 private:
  template <typename Value>
  Value value() {
    Value result;
    std::memcpy(&result, window_.take(sizeof(Value)), sizeof(Value));
    return result;
  }

  std::string text(uint64_t bytes) {
    const uint64_t end = end_ - window_.offset();
    if (bytes > end) fail(window_.place(), "a text of {} bytes goes beyond its record", bytes);
    return {reinterpret_cast<const char*>(window_.take(bytes)), bytes};
  }

  uint32_t named(uint32_t number, uint32_t count, const char* what) const {
    if (number >= count) fail(window_.place(), "names {} {} of {}", what, number, count);
    return number;
  }
  uint32_t named_or_none(uint32_t number, uint32_t count, const char* what) const {
    return number == no_record ? number : named(number, count, what);
  }

  /// False after the last record.
  bool next() {
    const auto kind = value<uint32_t>();
    const auto size = value<uint64_t>();
    if (size > window_.left())
      fail(window_.place(), "a record of {} bytes goes beyond the scene's end", size);
    end_ = window_.offset() + size;
    switch (static_cast<SceneRecord>(kind)) {
      case SceneRecord::material:
        read_material();
        break;
      case SceneRecord::mesh:
        read_mesh();
        break;
      case SceneRecord::property_set:
        read_property_set();
        break;
      case SceneRecord::object:
        read_object();
        break;
      case SceneRecord::instance:
        read_instance();
        break;
      case SceneRecord::geo_place:
        read_geo_place();
        break;
      case SceneRecord::end:
        read_end();
        return false;
      default:
        fail(window_.place(), "a record of unknown kind {}", kind);
    }
    if (window_.offset() != end_) fail(window_.place(), "a record does not end where it says");
    return true;
  }

  void read_material() {
    glm::vec4 color;
    for (int i = 0; i < 4; ++i) color[i] = value<float>();
    ++materials_;
    sink_.material(color);
  }

  void read_mesh() {
    SceneMesh mesh;
    const auto name_bytes = value<uint32_t>();
    mesh.coordinate_bytes = value<uint32_t>();
    mesh.vertex_count = value<uint32_t>();
    const auto parts = value<uint32_t>();
    if (mesh.coordinate_bytes != 4 && mesh.coordinate_bytes != 8)
      fail(window_.place(), "coordinates of {} bytes", mesh.coordinate_bytes);
    for (uint32_t i = 0; i < parts; ++i) {
      const auto triangles = value<uint32_t>();
      mesh.parts.push_back({triangles, named_or_none(value<uint32_t>(), materials_, "material")});
    }
    mesh.name = text(name_bytes);
    mesh.positions_at = window_.offset();
    mesh.indices_at = mesh.positions_at + uint64_t{mesh.vertex_count} * 3 * mesh.coordinate_bytes;
    if (mesh.indices_at + 12 * mesh.triangle_count() != end_)
      fail(window_.place(), "a mesh does not fill its record");
    window_.skip(end_ - window_.offset());
    ++meshes_;
    sink_.mesh(std::move(mesh));
  }

  /// Counted texts, then numbers.
  void read_texts(std::vector<std::string>& texts, std::vector<uint32_t>& numbers) {
    const auto text_count = value<uint32_t>(), number_count = value<uint32_t>();
    for (uint32_t i = 0; i < text_count; ++i) texts.push_back(text(value<uint32_t>()));
    for (uint32_t i = 0; i < number_count; ++i) numbers.push_back(value<uint32_t>());
  }

  void read_property_set() {
    std::vector<std::string> texts;
    std::vector<uint32_t> numbers;
    read_texts(texts, numbers);
    if (texts.size() % 2 != 1) fail(window_.place(), "a property set of {} texts", texts.size());
    ScenePropertySet set{std::move(texts.front()), {}};
    for (size_t i = 1; i < texts.size(); i += 2)
      set.properties.emplace_back(std::move(texts[i]), std::move(texts[i + 1]));
    ++property_sets_;
    sink_.property_set(std::move(set));
  }

  void read_object() {
    std::vector<std::string> texts;
    SceneObject object;
    read_texts(texts, object.property_sets);
    if (texts.size() != 6) fail(window_.place(), "an object of {} texts", texts.size());
    for (const uint32_t set : object.property_sets) named(set, property_sets_, "property set");
    object.id = std::move(texts[0]), object.name = std::move(texts[1]), object.guid = std::move(texts[2]);
    object.type = std::move(texts[3]), object.storey = std::move(texts[4]),
    object.layer = std::move(texts[5]);
    ++objects_;
    sink_.object(std::move(object));
  }

  void read_instance() {
    SceneInstance instance;
    instance.mesh = named(value<uint32_t>(), meshes_, "mesh");
    instance.material = named_or_none(value<uint32_t>(), materials_, "material");
    instance.object = named_or_none(value<uint32_t>(), objects_, "object");
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row) instance.transform[column][row] = value<double>();
    }
    ++instances_;
    sink_.instance(instance);
  }

  void read_geo_place() {
    GeoPlace place;
    for (double* const number :
         {&place.latitude, &place.longitude, &place.elevation, &place.north.x, &place.north.y})
      *number = value<double>();
    check_geo_place(place, window_.place());
    sink_.geo_place(place);
  }

  void read_end() {
    for (const uint32_t count : {materials_, meshes_, property_sets_, objects_, instances_}) {
      if (const auto written = value<uint32_t>(); written != count)
        fail(window_.place(), "its reader wrote {} records of a kind, not {}", count, written);
    }
  }

  SourceWindow window_;
  SceneSink& sink_;
  uint64_t end_ = 0;
  uint32_t materials_ = 0, meshes_ = 0, property_sets_ = 0, objects_ = 0, instances_ = 0;
};

}  // namespace

uint64_t SceneMesh::triangle_count() const {
  return std::accumulate(parts.begin(), parts.end(), uint64_t{0},
                         [](uint64_t sum, const ScenePart& part) { return sum + part.triangles; });
}

void read_scene_stream(const std::shared_ptr<const StreamSource>& source, SceneSink& sink) {
  Reader(source, sink).run();
}

}  // namespace triptych
