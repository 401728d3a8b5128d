// What most tests include of other libraries.
#include "json.hpp"

#include <gtest/gtest.h>
