#include "session/stored_program.hpp"

#include "aesl/abo.hpp"
#include "base/file.hpp"

namespace vagus::session {

Status store_program(const SoftwareNode& node, const std::string& path) {
    std::vector<uint16_t> words(node.program().begin(), node.program().end());
    if (words.empty()) words = {0};  // no program
    return write_file(path, aesl::format_abo(node.target(), {.node_id = node.id()}, words));
}

Result<Stored> load_stored_program(SoftwareNode& node, const std::string& path) {
    const Result<std::string> bytes = read_file(path);
    if (!bytes.ok() && bytes.error().code == Code::NotFound) return Stored::Absent;
    if (!bytes.ok()) return bytes.error();
    const aesl::Abo abo = TRY(aesl::parse_abo(bytes.value(), path));
    TRY(aesl::check_abo(abo, node.target(), path));
    TRY(node.load(abo.bytecode));
    return Stored::Loaded;
}

}  // namespace vagus::session
