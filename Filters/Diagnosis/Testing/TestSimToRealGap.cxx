#include <gtest/gtest.h>
TEST(SimToRealGap, Nothing){}
