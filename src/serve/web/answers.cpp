#include "serve/web/answers.hpp"

#include <fmt/format.h>

#include <charconv>

#include "serve/web/server.hpp"

namespace vagus::serve {

namespace {

namespace beast = boost::beast;
namespace http = beast::http;

// The page runs nothing but its own files; data: pictures are those that it draws itself.
constexpr const char* kContentPolicy =
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; font-src 'self'; connect-src 'self'; worker-src 'self' blob:; "
    "manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

// The page needs no device of the computer and no place; the clipboard is for copying.
constexpr const char* kPermissions =
    "accelerometer=(), camera=(), display-capture=(), geolocation=(), gyroscope=(), "
    "magnetometer=(), microphone=(), midi=(), payment=(), serial=(), usb=()";

void secure(Answer& answer) {
    answer.set(http::field::server, "Vagus");
    answer.set("Content-Security-Policy", kContentPolicy);
    answer.set("Permissions-Policy", kPermissions);
    answer.set("X-Content-Type-Options", "nosniff");
    answer.set("X-Frame-Options", "DENY");
    answer.set("Referrer-Policy", "no-referrer");
    answer.set("Cross-Origin-Opener-Policy", "same-origin");
    answer.set("Cross-Origin-Resource-Policy", "same-origin");
}

Answer page_answer(const Asking& asked, const Page& page) {
    Answer answer(http::status::ok, asked.version());
    secure(answer);
    answer.set(http::field::content_type, page.type);
    answer.set(http::field::cache_control,
               page.lasting ? "public, max-age=31536000, immutable" : "no-cache");
    const bool zipped = !page.gzipped.empty() && asked[http::field::accept_encoding].find("gzip") !=
                                                     beast::string_view::npos;
    if (zipped) answer.set(http::field::content_encoding, "gzip");
    answer.keep_alive(asked.keep_alive());
    const std::string& content = zipped ? page.gzipped : page.content;
    if (asked.method() == http::verb::head) {
        answer.content_length(content.size());
    } else {
        answer.body() = content;
        answer.prepare_payload();
    }
    return answer;
}

// "Authorization: Bearer TOKEN" (RFC 6750, 2.1); the address has no place for a secret.
std::string_view token_of(const Asking& asked) {
    static constexpr std::string_view kScheme = "Bearer ";
    const auto given = asked[http::field::authorization];
    const std::string_view header(given.data(), given.size());
    return header.starts_with(kScheme) ? header.substr(kScheme.size()) : std::string_view();
}

Answer without_token(const Asking& asked, const Shown& shown) {
    shown.note(fmt::format("refused: {} without the right token", std::string(asked.target())));
    Answer answer =
        plain(asked, http::status::unauthorized, "expected the header Authorization: Bearer TOKEN");
    answer.set(http::field::www_authenticate, "Bearer");
    return answer;
}

// "/stop", or "/stop?client=7" of a page: its number, or 0. Whatever else follows, it is a Stop.
std::optional<uint32_t> stopping_client(std::string_view target) {
    constexpr std::string_view kStop = "/stop", kClient = "/stop?client=";
    if (target != kStop && !target.starts_with("/stop?")) return std::nullopt;
    uint32_t number = 0;
    if (!target.starts_with(kClient)) return number;
    target.remove_prefix(kClient.size());
    (void)std::from_chars(target.data(), target.data() + target.size(), number);
    return number;
}

// Without JSON, without a page and without a WebSocket: nothing is in front of it.
Answer stop_answer(const Asking& asked, const Shown& shown, uint32_t client) {
    if (!shown.may_look(token_of(asked))) return without_token(asked, shown);
    shown.stop(client);
    return plain(asked, http::status::accepted, "Stop sent");
}

Answer metrics_answer(const Asking& asked, const Shown& shown) {
    if (!shown.may_look(token_of(asked))) return without_token(asked, shown);
    Answer answer = plain(asked, http::status::ok, "");
    answer.set(http::field::content_type, "text/plain; version=0.0.4; charset=utf-8");
    answer.body() = *shown.metrics;
    answer.prepare_payload();
    return answer;
}

}  // namespace

Answer plain(const Asking& asked, http::status status, const std::string& sentence) {
    Answer answer(status, asked.version());
    secure(answer);
    answer.set(http::field::content_type, "text/plain; charset=utf-8");
    answer.set(http::field::cache_control, "no-store");
    answer.keep_alive(asked.keep_alive() && status == http::status::ok);
    answer.body() = sentence + "\n";
    answer.prepare_payload();
    return answer;
}

std::optional<std::string> ambiguity_of(const Asking& asked) {
    if (asked.count(http::field::host) > 1) return "expected one Host";
    const size_t codings = asked.count(http::field::transfer_encoding);
    const auto coding = asked[http::field::transfer_encoding];
    if (codings > 1 || (codings == 1 && !beast::iequals(coding, "chunked"))) {
        return "this Transfer-Encoding is not known; expected chunked, or none";
    }
    return std::nullopt;
}

Answer answer_for(const Asking& asked, const Shown& shown) {
    if (asked.method() == http::verb::post) {
        const std::string_view target(asked.target().data(), asked.target().size());
        const auto client = stopping_client(target);
        if (client) return stop_answer(asked, shown, *client);
    }
    if (asked.method() != http::verb::get && asked.method() != http::verb::head) {
        return plain(asked, http::status::method_not_allowed,
                     "only GET and HEAD are answered, and POST of /stop");
    }
    if (asked.target() == "/healthz") {
        return shown.ill.empty() ? plain(asked, http::status::ok, "ok")
                                 : plain(asked, http::status::service_unavailable, shown.ill);
    }
    if (asked.target() == "/live") {
        return plain(asked, http::status::bad_request,
                     fmt::format("expected a WebSocket with the subprotocol {}", kLiveProtocol));
    }
    if (asked.target() == "/metrics" && shown.metrics) return metrics_answer(asked, shown);
    const Page* page = shown.pages.find({asked.target().data(), asked.target().size()});
    return page ? page_answer(asked, *page)
                : plain(asked, http::status::not_found, "there is no such page");
}

}  // namespace vagus::serve
