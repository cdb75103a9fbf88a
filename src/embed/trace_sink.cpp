#include "embed/trace_sink.hpp"

namespace vagus::embed {

Result<std::unique_ptr<TraceSink>> TraceSink::open(const std::string& path, bool at_once) {
    auto sink = std::make_unique<TraceSink>();
    sink->at_once_ = at_once;
    if (path == "-") sink->file_ = stdout;
    if (path.empty() || path == "-") return sink;
    sink->file_ = std::fopen(path.c_str(), "wb");
    sink->owned_ = true;
    if (sink->file_) return sink;
    return Error{Code::Unavailable, "the trace " + path + " cannot be written"};
}

TraceSink::~TraceSink() {
    if (owned_ && file_) std::fclose(file_);
}

void TraceSink::write(std::string_view lines) {
    if (!file_) return;
    std::fwrite(lines.data(), 1, lines.size(), file_);
    if (at_once_) std::fflush(file_);
}

}  // namespace vagus::embed
