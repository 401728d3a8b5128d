// What rooms that read or write JSON include of other libraries.
#include "room.hpp"

#include <nlohmann/json.hpp>
