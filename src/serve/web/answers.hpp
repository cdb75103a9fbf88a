// What a request is answered: pages, /healthz, /metrics, or why not.
#pragma once

#include <boost/beast/http.hpp>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "serve/web/pages.hpp"

namespace vagus::serve {

using Asking = boost::beast::http::request<boost::beast::http::string_body>;
using Answer = boost::beast::http::response<boost::beast::http::string_body>;

// What there is to see; borrowed for the call.
struct Shown {
    const Pages& pages;
    const std::optional<std::string>& metrics;
    const std::string& ill;  // why /healthz does not say ok; empty: it does
    const std::function<bool(std::string_view token)>& may_look;
    std::function<void(uint32_t client)> stop;  // somebody with a token wants everything to stop
    std::function<void(std::string)> note;      // for the log
};

// What another server between us could read otherwise than we do: a sentence.
std::optional<std::string> ambiguity_of(const Asking& asked);

Answer answer_for(const Asking& asked, const Shown& shown);
// A sentence.
Answer plain(const Asking& asked, boost::beast::http::status status, const std::string& sentence);

}  // namespace vagus::serve
