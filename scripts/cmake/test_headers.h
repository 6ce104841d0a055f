// What most tests include of other people's headers: as library_headers.h.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scripts/cmake/library_headers.h"
