// A node without natives: what the machine, its debugger, the links and the board take by
// themselves.
#define VAGUS_NATIVES \
    { nullptr, 0 }
#include "firmware/node/face.inl"
