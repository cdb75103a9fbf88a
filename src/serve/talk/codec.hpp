// Orders and news as packets of a pipe, and back: the one border between the server and the process
// of a run. Nothing behind it has to look whether a field is there.
//
//     pipe.send(talk::encode(talk::Order(talk::StepPlan{})));
//     const auto news = talk::decode_news(packet);
//     if (!news.ok()) end_it(news.error().what);  // "clock.t: expected a number, found a text"
#pragma once

#include "base/result.hpp"
#include "serve/process.hpp"
#include "serve/talk/news.hpp"
#include "serve/talk/orders.hpp"

namespace vagus::serve::talk {

Packet encode(const Order& order);
Packet encode(const News& news);

// Whatever the bytes are. The Error names the message, the field, what was expected and found.
Result<Order> decode_order(const Packet& packet);
Result<News> decode_news(const Packet& packet);

}  // namespace vagus::serve::talk
