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
    const std::function<bool(std::string_view token)>& may_look;
    std::function<void(std::string)> note;  // for the log
};

Answer answer_for(const Asking& asked, const Shown& shown);
// A sentence.
Answer plain(const Asking& asked, boost::beast::http::status status, const std::string& sentence);

}  // namespace vagus::serve
