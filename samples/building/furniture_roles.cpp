#include "samples/building/furniture_roles.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

namespace triptych {
namespace {

/// Categories and words are lists separated by |; a word matches at the start of any word of the name, an
/// entry that begins with = matches the whole name.
struct Rule {
  FurnitureRole role;
  const char* categories;
  const char* words;
  glm::dvec3 least, most;  ///< width, height, depth
  size_t models;           ///< how many at most
};

const Rule rules[] = {
    {FurnitureRole::desk,
     "Office|Living room",
     "desk|wooden table|wooden alder|wooden teak|glass table|=table|black table",
     {0.95, 0.65, 0.5},
     {2.0, 0.8, 0.96},
     16},
    {FurnitureRole::office_chair,
     "Office",
     "chair|armchair|class seat",
     {0.4, 0.7, 0.4},
     {0.72, 1.1, 0.72},
     6},
    {FurnitureRole::computer, "Office", "apple|laptop", {0.2, 0.15, 0.2}, {0.6, 0.6, 0.6}, 6},
    {FurnitureRole::chair,
     "Living room|Kitchen|Exterior",
     "=chair|oak chair|osaka|plastic chair|cafe chair|chair with cushion",
     {0.3, 0.7, 0.3},
     {0.62, 1.2, 0.65},
     22},
    {FurnitureRole::big_table, "Office|Living room", "table", {1.35, 0.65, 0.6}, {2.4, 0.8, 1.25}, 12},
    {FurnitureRole::small_table,
     "Living room|Exterior",
     "round table|=table|cafe table|oak table|white kitchen table",
     {0.5, 0.6, 0.5},
     {1.3, 0.8, 1.3},
     9},
    {FurnitureRole::bookcase,
     "Living room|Office|Bedroom",
     "bookcase|full bookcase|shelves|vertical shelves|cupboard",
     {0.4, 1.1, 0.25},
     {1.7, 2.4, 0.6},
     10},
    {FurnitureRole::cabinet,
     "Office|Bedroom|Living room",
     "filing|chest|dresser|=shelves|bedside",
     {0.3, 0.4, 0.3},
     {1.7, 1.0, 0.7},
     8},
    {FurnitureRole::ceiling_light,
     "Lights",
     "fluorescent light|ceiling lamp|hanging light|fluorescent strip|track",
     {0, 0, 0},
     {1.2, 0.9, 0.6},
     6},
    {FurnitureRole::dustbin,
     "Office|Kitchen|Miscellaneous",
     "dustbin|bullet trash|recycling",
     {0, 0.2, 0},
     {0.5, 0.8, 0.5},
     4},
    {FurnitureRole::desk_lamp,
     "Lights",
     "desk lamp|lamp|little lamp|japanese",
     {0, 0.3, 0},
     {0.45, 0.65, 0.45},
     10},
    {FurnitureRole::phone, "Office|Living room", "phone|wireless", {0, 0.05, 0}, {0.3, 0.3, 0.3}, 3},
    {FurnitureRole::desk_item,
     "Office|Miscellaneous|Lights|Bedroom",
     "letter tray|penbox|calendar|stapler|tablet|newspaper|scissors|text "
     "marker|frame|glasses|reflex|camera|headphones|"
     "mobile|apple iphone|keys|=clock|tape measure|rubik|ruler|sunglasses|=tape|pencil",
     {0, 0, 0},
     {0.4, 0.3, 0.4},
     30},
    {FurnitureRole::mug,
     "Kitchen",
     "coffee mug|coffee cup|=cup|=glass|plastic cup",
     {0, 0, 0},
     {0.2, 0.2, 0.2},
     10},
    {FurnitureRole::book,
     "Miscellaneous|Living room|Office",
     "book|letter tray|newspaper|=box|=gift",
     {0, 0, 0},
     {0.35, 0.3, 0.4},
     5},
    {FurnitureRole::small_plant,
     "Living room",
     "plant|cactus|bamboo|bonsai|little plant|succulent|orchids|tulips|vase",
     {0, 0, 0},
     {0.5, 0.6, 0.5},
     12},
    {FurnitureRole::floor_plant,
     "Living room",
     "plant|ficus|decorative plant|yucca|indoor|spathiphyllum",
     {0.3, 0.55, 0.3},
     {1.1, 2.0, 1.1},
     8},
    {FurnitureRole::socket,
     "Miscellaneous",
     "wall double socket|wall socket|wall type|square type|rounded type|wall rj45|rounded rj45",
     {0, 0, 0},
     {0.2, 0.12, 0.05},
     14},
    {FurnitureRole::light_switch,
     "Miscellaneous",
     "wall switch|square switch|rounded switch|wall double switch|square double|wall dimmer",
     {0, 0, 0},
     {0.2, 0.12, 0.05},
     6},
    {FurnitureRole::smoke_detector, "Miscellaneous", "smoke", {0, 0, 0}, {0.3, 0.3, 0.3}, 1},
    {FurnitureRole::radiator, "Miscellaneous", "radiator", {0.4, 0.3, 0}, {1.5, 0.86, 0.3}, 4},
    {FurnitureRole::blind, "Miscellaneous", "window blind|curtain", {0.5, 0.5, 0}, {1.5, 2.4, 0.1}, 2},
    {FurnitureRole::sofa,
     "Living room",
     "sofa|couch|futon|burlap|clear sofa|winchester sofa",
     {1.5, 0.6, 0.6},
     {2.4, 1.1, 1.0},
     18},
    {FurnitureRole::armchair,
     "Living room",
     "armchair|modern armchair|winchester armchair|puff",
     {0.5, 0.55, 0.5},
     {1.15, 1.05, 1.0},
     14},
    {FurnitureRole::coffee_table,
     "Living room",
     "coffee table|=table|rattan table",
     {0.6, 0.35, 0.4},
     {1.5, 0.56, 0.8},
     7},
    {FurnitureRole::rug,
     "Living room|Miscellaneous|Bathroom",
     "oriental|round carpet|tatami|doormat",
     {0.5, 0, 0.2},
     {2.0, 0.06, 2.7},
     5},
    {FurnitureRole::whiteboard, "Office", "white board", {0.5, 1, 0}, {2, 2, 1}, 1},
    {FurnitureRole::wall_screen, "Living room", "wall flat", {0.5, 0.3, 0}, {2, 1.5, 0.3}, 1},
    {FurnitureRole::projector, "Living room", "video projector", {0, 0, 0}, {0.6, 0.5, 0.6}, 1},
    {FurnitureRole::printer, "Office|Kitchen", "inkjet", {0, 0, 0}, {0.7, 0.6, 0.7}, 2},
    {FurnitureRole::box,
     "Miscellaneous",
     "cardboard|open cardboard|=box|crate|trunck|pallet|barrel|suitcase",
     {0.2, 0.1, 0.2},
     {1.25, 0.95, 1.25},
     9},
    {FurnitureRole::shelf, "Living room|Bedroom", "shelves|utility", {0.4, 0.7, 0.2}, {1.1, 2.0, 0.6}, 5},
    {FurnitureRole::ladder,
     "Miscellaneous",
     "step|small step|workbench|wheelchair",
     {0, 0.5, 0},
     {1.3, 2, 1.0},
     4},
    {FurnitureRole::kitchen_base,
     "Kitchen",
     "lower cabinet|drawers|small lower",
     {0.4, 0.8, 0.55},
     {1.0, 0.95, 0.65},
     6},
    {FurnitureRole::kitchen_sink, "Kitchen", "sink", {0.5, 0.8, 0.5}, {1.1, 1.3, 0.7}, 2},
    {FurnitureRole::kitchen_stove,
     "Kitchen",
     "clothes washing|dryer|washing machine|large stove|propane",
     {0.5, 0.55, 0.5},
     {1.1, 0.9, 0.75},
     4},
    {FurnitureRole::kitchen_upper,
     "Kitchen",
     "upper cabinet|glass door|small upper|upper shelves",
     {0.3, 0.5, 0.25},
     {1.2, 0.8, 0.45},
     6},
    {FurnitureRole::fridge,
     "Kitchen",
     "refrigerator|fridge|large fridge|high cabinet|double oven|chest freezer",
     {0.5, 0.6, 0.5},
     {1.05, 2.2, 1.0},
     6},
    {FurnitureRole::appliance,
     "Kitchen",
     "coffee machine|coffee maker|microwave|toaster|cooker|small oven|coffee brewer|bread box|boiler|coffee "
     "press",
     {0, 0.1, 0},
     {0.6, 0.45, 0.5},
     10},
    {FurnitureRole::food,
     "Kitchen",
     "bread|apples|bowl|butter|cup cake|birthday|hamburger|sushi|roasted|salt|sugar|tray|paper "
     "towel|chopping|milk|knife stand",
     {0, 0, 0},
     {0.5, 0.4, 0.4},
     20},
    {FurnitureRole::plate, "Kitchen", "plate|oval plate", {0, 0, 0}, {0.5, 0.2, 0.45}, 5},
    {FurnitureRole::bottle,
     "Kitchen",
     "beer bottle|wine bottle|milk|yogurt|oil|glass|baby bottle|utensils",
     {0, 0.1, 0},
     {0.2, 0.45, 0.2},
     8},
    {FurnitureRole::stool,
     "Kitchen|Living room",
     "stool|bar chair|bar stool|green stool",
     {0.25, 0.4, 0.25},
     {0.6, 1.15, 0.6},
     6},
    {FurnitureRole::toilet, "Bathroom", "toilets unit", {0.3, 0.6, 0.4}, {0.5, 0.9, 0.9}, 3},
    {FurnitureRole::urinal, "Bathroom", "urinal", {0.2, 0.4, 0.2}, {0.5, 1.0, 0.5}, 2},
    {FurnitureRole::washbasin, "Bathroom", "washbasin|small lavatory", {0.4, 0.3, 0.3}, {0.75, 1.0, 0.65}, 5},
    {FurnitureRole::paper_dispenser, "Bathroom", "toilet paper", {0, 0, 0}, {0.3, 0.3, 0.3}, 2},
    {FurnitureRole::towel, "Bathroom", "towel rack|towel", {0.15, 0.05, 0}, {0.65, 0.7, 0.2}, 4},
    {FurnitureRole::soap,
     "Bathroom",
     "soap|flacon|cosmetics|bottle|sponge",
     {0, 0, 0},
     {0.12, 0.25, 0.12},
     5},
    {FurnitureRole::water_cooler, "Office", "water cooler", {0, 0.5, 0}, {0.6, 1.6, 0.6}, 1},
    {FurnitureRole::extinguisher, "Miscellaneous", "extinguisher", {0, 0, 0}, {0.6, 1, 0.6}, 1},
    {FurnitureRole::emergency_sign, "Miscellaneous", "emergency", {0, 0, 0}, {1, 1, 0.3}, 1},
    {FurnitureRole::bench,
     "Living room|Exterior",
     "bench|painted bench|concrete bench|little bank",
     {1.0, 0.4, 0.4},
     {2.0, 0.85, 0.62},
     5},
    {FurnitureRole::camera, "Miscellaneous", "cctv|surveillance", {0, 0, 0}, {0.4, 0.4, 0.5}, 2},
    {FurnitureRole::hanger,
     "Miscellaneous",
     "wall hanger|intercom|air conditioning - internal",
     {0, 0, 0},
     {0.95, 0.6, 0.25},
     4},
    {FurnitureRole::person,
     "Characters",
     "female|male|mannequin|holding|girl|boy",
     {0.3, 1.5, 0.2},
     {0.85, 1.9, 0.6},
     12},
    {FurnitureRole::game,
     "Miscellaneous|Living room",
     "pool table|table tennis|football table|flipper|upright piano|grand piano",
     {0.6, 0.7, 0.5},
     {2.8, 1.9, 1.8},
     6},
    {FurnitureRole::exercise,
     "Miscellaneous",
     "abdominal|treadmill|indoor bike|punching|fitness",
     {0.4, 0.6, 0.4},
     {2.3, 2.1, 2.0},
     5},
    {FurnitureRole::floor_lamp, "Lights", "=lamp", {0.2, 1.2, 0.2}, {0.7, 2.5, 0.7}, 3},
    {FurnitureRole::ornament,
     "Living room|Miscellaneous|Lights|Bedroom",
     "vase|candle|aquarium|deer|cuckoo|=flowers|=tulips|white lily|speaker|mini "
     "stereo|radio|dvd|stereo|teddy|chessboard|basketball|soccer",
     {0, 0.05, 0},
     {0.72, 0.75, 0.5},
     20},
    {FurnitureRole::wall_lamp,
     "Lights",
     "wall light|wall lamp|wall spotlight|porch light",
     {0, 0, 0},
     {0.4, 0.6, 0.4},
     3},
    {FurnitureRole::cleaning,
     "Kitchen|Miscellaneous|Exterior|Bathroom",
     "broom|clothes horse|spray|clothes basket|park trashcan|residential",
     {0, 0.2, 0},
     {0.8, 1.7, 0.97},
     5},
    {FurnitureRole::safe_box,
     "Office|Miscellaneous",
     "safe|locked locker",
     {0.15, 0.2, 0.15},
     {0.6, 0.6, 0.6},
     2},
    {FurnitureRole::device,
     "Miscellaneous|Living room|Office",
     "tv 16|=tv|mp3|playstation|joystick|table fan|rigged fan|keyboard",
     {0, 0, 0},
     {0.85, 0.55, 0.4},
     8},
};

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const size_t end = std::min(text.find('|'), text.size());
    parts.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

bool named(const std::string& name, std::string_view word) {
  if (word[0] == '=') return name == word.substr(1);
  for (size_t at = name.find(word); at != std::string::npos; at = name.find(word, at + 1))
    if (at == 0 || name[at - 1] == ' ') return true;
  return false;
}

bool fits(const FurniturePiece& piece, const Rule& rule) {
  if (piece.door_or_window && rule.role != FurnitureRole::blind) return false;
  if (glm::any(glm::lessThan(piece.size, rule.least)) || glm::any(glm::greaterThan(piece.size, rule.most)))
    return false;
  const auto categories = split(rule.categories);
  if (std::find(categories.begin(), categories.end(), piece.category) == categories.end()) return false;
  std::string name = piece.name;
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const auto words = split(rule.words);
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return named(name, word); });
}

}  // namespace

uint64_t guessed_triangles(const FurniturePiece& piece) {
  constexpr uint64_t bytes_per_triangle = 36;
  return piece.model_bytes / bytes_per_triangle + 1;
}

RolePools choose_pools(const Furniture& furniture, uint64_t unique_triangles, size_t models, Random random) {
  const auto smaller = [&](size_t a, size_t b) {
    return furniture.pieces[a].model_bytes < furniture.pieces[b].model_bytes;
  };
  std::array<std::vector<size_t>, role_count> candidates;
  std::array<size_t, role_count> most{};
  RolePools pools;
  std::set<size_t> taken;
  uint64_t triangles = 0;
  const auto take = [&](size_t role, size_t piece) {
    pools.pieces[role].push_back(piece);
    if (taken.insert(piece).second) triangles += guessed_triangles(furniture.pieces[piece]);
  };
  for (const Rule& rule : rules) {
    const auto role = static_cast<size_t>(rule.role);
    most[role] = rule.models;
    for (size_t piece = 0; piece < furniture.pieces.size(); ++piece)
      if (fits(furniture.pieces[piece], rule)) candidates[role].push_back(piece);
    if (candidates[role].empty()) continue;
    std::sort(candidates[role].begin(), candidates[role].end(), smaller);
    take(role, candidates[role][0]);
    candidates[role].erase(candidates[role].begin());
    random.shuffle(candidates[role]);
  }
  // One more model for each role in turn, as long as the budget allows.
  for (size_t round = 0; round < 32; ++round) {
    for (size_t role = 0; role < role_count; ++role) {
      if (round >= candidates[role].size() || pools.pieces[role].size() >= most[role]) continue;
      const size_t piece = candidates[role][round];
      const uint64_t cost = taken.count(piece) ? 0 : guessed_triangles(furniture.pieces[piece]);
      if (cost > 0 && (taken.size() >= models || triangles + cost > unique_triangles)) continue;
      take(role, piece);
    }
  }
  return pools;
}

}  // namespace triptych
