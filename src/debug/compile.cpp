// The one place where debug calls the compiler.
#include <cassert>

#include "debug/network.hpp"

namespace vagus::debug {

aesl::Compilation Network::compile(NodeId id, std::string_view source,
                                   const aesl::Options& options) const {
    const NodeView* known = node(id);
    assert(known != nullptr && known->described);
    return aesl::compile(source, known->target, common(), options);
}

}  // namespace vagus::debug
