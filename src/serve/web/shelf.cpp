#include "serve/web/shelf.hpp"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <utility>

#include "base/file.hpp"
#include "base/text.hpp"
#include "serve/process.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kShelfTokenBytes = 24;
constexpr const char* kHere = "127.0.0.1:0";

}  // namespace

Shelf::Shelf(TemporaryFolder folder)
    : folder_(std::move(folder)), token_(hex_of(random_bytes(kShelfTokenBytes))) {}

Result<std::unique_ptr<Shelf>> Shelf::open(const ShelfOptions& options, const std::string& bytes) {
    TemporaryFolder own = TRY(TemporaryFolder::make("shelf"));
    // make_unique cannot reach the constructor.
    std::unique_ptr<Shelf> shelf(new Shelf(std::move(own)));
    const std::filesystem::path folder = shelf->folder_.path();
    TRY(write_file(folder / "index.html", "A version of a fleet of Vagus.\n"));
    TRY(write_file(folder / shelf->token_, bytes));
    TRY(shelf->serve(options));
    return shelf;
}

Status Shelf::serve(const ShelfOptions& options) {
    const std::string listen = options.listen.empty() ? kHere : options.listen;
    WebOptions web{
        .pages = folder_.path(), .tls_cert = options.certificate, .tls_key = options.key};
    const size_t colon = listen.rfind(':');
    const std::string port = colon == std::string::npos ? "" : listen.substr(colon + 1);
    const char* const end = port.data() + port.size();
    const auto read = std::from_chars(port.data(), end, web.port);
    if (port.empty() || read.ec != std::errc() || read.ptr != end) {
        return Error{Code::BadInput,
                     fmt::format("{} {}: expected ADDRESS:PORT, such as 0.0.0.0:8443",
                                 options.listen_word, listen)};
    }
    web.address = listen.substr(0, colon);
    const bool here = web.address.starts_with("127.");
    if (!here && options.certificate.empty()) {
        return Error{
            Code::BadInput,
            fmt::format("{} {}: robots fetch from another computer by HTTPS alone; name a "
                        "certificate that they trust: {} FILE {} FILE",
                        options.listen_word, listen, options.certificate_word, options.key_word)};
    }
    const std::string host = !options.host.empty() ? options.host
                             : here                ? "localhost"
                                                   : host_name();
    web.hosts = {host};
    server_ = TRY(WebServer::start(web, [] {}));
    address_ = fmt::format("{}://{}:{}/{}", options.certificate.empty() ? "http" : "https", host,
                           server_->port(), token_);
    return Status::done();
}

}  // namespace vagus::serve
