#include "cli/screen/panel.hpp"

#include <algorithm>
#include <array>

#include "cli/screen/degrees.hpp"
#include "cli/screen/page.hpp"

namespace vagus::cli {
namespace {

constexpr Duration kFlash = std::chrono::milliseconds(300);  // an event is shown bright for so long
constexpr int kSpare = 2;  // rows that a list leaves for the next one at least

std::string words_of(const std::vector<int16_t>& values) {
    std::string text;
    for (const int16_t value : values) text += (text.empty() ? "" : " ") + std::to_string(value);
    return text;
}

// A bar of one cell, eight heights.
std::string_view bar(int value, int full, Charset charset) {
    static constexpr std::array<std::string_view, 9> kBlocks = {" ", "▁", "▂", "▃", "▄",
                                                                "▅", "▆", "▇", "█"};
    static constexpr std::array<std::string_view, 9> kLetters = {"_", ".", ".", ":", ":",
                                                                 "+", "+", "#", "#"};
    const double part = full > 0 ? std::clamp(1.0 * value / full, 0.0, 1.0) : 0;
    const auto index = static_cast<size_t>(std::ceil(part * 8));
    if (charset == Charset::Ascii) return kLetters.at(index);
    return index == 0 ? "▁" : kBlocks.at(index);
}

void add_robot(Page& page, const View& view, Charset charset) {
    const PanelView& panel = view.panel;
    const std::string id = "  node " + std::to_string(panel.node_id);
    const int room = page.columns() - text_width(id) - text_width(panel.state) - 1;
    page.add(shortened(panel.node_name, std::max(room, page.columns() / 3), charset),
             {kHead, {}, true});
    page.add(id, {kDim, {}, false});
    page.add_right(panel.state, {panel.wrong ? kBad : kGood, {}, true});
    page.next();
    if (view.selected >= view.robots.size()) return;
    const RobotPicture& robot = view.robots[view.selected];
    const std::string degree = charset == Charset::Ascii ? " deg" : "°";
    page.add("at " + fixed(robot.at.x, 2) + ", " + fixed(robot.at.y, 2) + " m  " +
                 std::to_string(degrees_shown(robot.angle)) + degree,
             {});
    page.next();
}

void add_sensors(Page& page, const PanelView& panel, Charset charset) {
    size_t label = 0;
    for (const BarsView& bars : panel.bars) label = std::max(label, bars.label.size());
    for (const WheelView& wheel : panel.wheels) label = std::max(label, wheel.label.size());
    for (const BarsView& bars : panel.bars) {
        page.add(bars.label, {kDim, {}, false});
        page.jump(static_cast<int>(label) + 1);
        for (const int value : bars.values) {
            page.add(bar(value, bars.full, charset), {kBar, {}, false});
        }
        std::string figures;
        for (const int value : bars.values) figures += " " + std::to_string(value);
        page.add(shortened(figures, page.columns() - page.column(), charset), {});
        page.next();
    }
    for (const WheelView& wheel : panel.wheels) {
        page.add(wheel.label, {kDim, {}, false});
        page.jump(static_cast<int>(label) + 1);
        page.add(wheel.target_word + " " + std::to_string(wheel.target), {});
        page.jump(static_cast<int>(label) + 11);
        page.add(" " + wheel.speed_word + " " + std::to_string(wheel.speed), {});
        page.next();
    }
}

void add_variables(Page& page, const PanelView& panel, int rows) {
    heading(page, "variables");
    if (panel.variables.empty()) {
        page.add("the script has none", {kDim, {}, false});
        page.next();
        return;
    }
    size_t shown = panel.variables.size();
    if (static_cast<int>(shown) > rows) shown = static_cast<size_t>(std::max(rows - 1, 0));
    for (size_t i = 0; i < shown; i++) {
        const VariableView& variable = panel.variables[i];
        const Ink ink{variable.fresh ? Colour(kFresh) : Colour(), {}, variable.fresh};
        page.pair(variable.name, {}, words_of(variable.values), ink);
    }
    if (shown < panel.variables.size()) more(page, panel.variables.size() - shown);
}

void add_event(Page& page, const EventView& event, Time now, Charset charset) {
    const bool bright = now - event.last < kFlash;
    page.add(shortened(event.name, page.columns() / 2, charset),
             {bright ? Colour(kFresh) : Colour(), {}, bright});
    page.add(" ", {});
    const std::string count =
        (charset == Charset::Ascii ? " x" : " ×") + std::to_string(event.count);
    const int room = page.columns() - page.column() - text_width(count);
    page.add(shortened(words_of(event.args), room, charset), {});
    page.add_right(count, {kDim, {}, false});
    page.next();
}

void add_events(Page& page, const View& view, Charset charset) {
    const auto& events = view.panel.events;
    const size_t first = std::min(view.scrolled, events.empty() ? 0 : events.size() - 1);
    heading(page, first == 0 ? "events" : "events, " + std::to_string(first) + " above");
    if (events.empty()) {
        page.add("none yet: emit shows here", {kDim, {}, false});
        page.next();
        return;
    }
    for (size_t i = first; i < events.size(); i++) {
        if (page.full()) return;
        if (page.rows_left() == 1 && i + 1 < events.size()) return more(page, events.size() - i);
        add_event(page, events[i], view.now, charset);
    }
}

}  // namespace

void draw_panel(Grid& grid, Area area, const View& view, const Look& look) {
    Page page(grid, area, look.charset);
    add_robot(page, view, look.charset);
    add_sensors(page, view.panel, look.charset);
    const int events = std::max<int>(1, static_cast<int>(view.panel.events.size())) + 1;
    const int left = page.rows_left() - 1;  // under the heading
    const int rows = std::max(left - std::min(events, std::max(left / 3, kSpare)), 1);
    add_variables(page, view.panel, rows);
    add_events(page, view, look.charset);
}

}  // namespace vagus::cli
