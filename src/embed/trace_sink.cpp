#include "embed/trace_sink.hpp"

namespace vagus::embed {

Result<std::unique_ptr<TraceSink>> TraceSink::open(const std::string& path) {
    auto sink = std::make_unique<TraceSink>();
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
    if (file_) std::fwrite(lines.data(), 1, lines.size(), file_);
}

}  // namespace vagus::embed
