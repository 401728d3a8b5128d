// What most commands include of other libraries.
#include "json.hpp"

#include <CLI/CLI.hpp>
