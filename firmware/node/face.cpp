// The node as it is shipped: with the standard natives.
#include "node/natives.hpp"

#define VAGUS_NATIVES \
    { node::kStandardNatives, node::kStandardNativeCount }
#include "firmware/node/face.inl"
