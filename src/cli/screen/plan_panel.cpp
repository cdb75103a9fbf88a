#include "cli/screen/plan_panel.hpp"

#include <cmath>

#include "cli/screen/page.hpp"

namespace vagus::cli {

namespace {

constexpr int kActorsMax = 9;  // lines of each list at most
constexpr int kWatchingMax = 5;
constexpr int kVariablesMax = 6;
constexpr int kLoadsMax = 6;
constexpr int kHappeningsMin = 4;  // lines that the other lists leave
constexpr int kBarColumns = 10;
constexpr double kBarFull = 0.01;  // of the bus: a full bar stands for the highest, at least this

// Arrows only where a terminal can draw them.
std::string in_charset(const std::string& text, Charset charset) {
    constexpr std::string_view kArrow = "→";
    std::string out = text;
    if (charset == Charset::Unicode) return out;
    for (size_t at = out.find(kArrow); at != std::string::npos; at = out.find(kArrow)) {
        out.replace(at, kArrow.size(), "->");
    }
    return out;
}

std::string percent(double share) {
    return fixed(100 * share, 2) + " %";
}

class PlanPanel {
public:
    PlanPanel(Grid& grid, Area area, const PlanPanelView& plan, const Look& look)
        : page_(grid, area), plan_(plan), charset_(look.charset) {}

    void draw() {
        page_.add(plan_.name, {kHead, {}, true});
        page_.add_right(plan_.state, {plan_.wrong ? kBad : kGood, {}, true});
        page_.next();
        actors();
        watching();
        variables();
        loads();
        happenings();
    }

private:
    // Lines for a list of `count`, so that what follows keeps some.
    int room(size_t count, int most) const {
        const int left = page_.rows_left() - 1 - kHappeningsMin - reserved_;
        return std::max(1, std::min({static_cast<int>(count), most, left}));
    }

    // A part around the active one, if there are more than fit.
    void actors() {
        const auto& all = plan_.actors;
        const int rows = room(all.size(), kActorsMax);
        int active = 0;
        for (size_t i = 0; i < all.size(); ++i) {
            if (all[i].active) active = static_cast<int>(i);
        }
        const int last = static_cast<int>(all.size()) - rows;
        const int first = std::clamp(active - rows / 2, 0, std::max(last, 0));
        for (int i = first; i < first + rows && i < static_cast<int>(all.size()); ++i) {
            actor(all[static_cast<size_t>(i)]);
        }
    }

    void actor(const ActorView& actor) {
        const std::string mark = charset_ == Charset::Ascii ? "> " : "▶ ";
        const std::string indent(static_cast<size_t>(2 * actor.depth), ' ');
        const Ink ink{actor.active ? Colour(kFresh) : Colour(kDim), {}, actor.active};
        page_.add(indent + (actor.active ? mark : "  "), ink);
        page_.add(shortened(actor.name, page_.columns() - page_.column() - 9, charset_), ink);
        if (actor.active) {
            const double seconds = std::chrono::duration<double>(actor.for_so_long).count();
            page_.add_right(fixed(seconds, 1) + " s", {kFresh, {}, false});
        }
        page_.next();
    }

    void watching() {
        heading(page_, "watching", charset_);
        if (plan_.watching.empty()) nothing("nobody");
        const int rows = room(plan_.watching.size(), kWatchingMax);
        for (int i = 0; i < rows && i < static_cast<int>(plan_.watching.size()); ++i) {
            const WatchView& watch = plan_.watching[static_cast<size_t>(i)];
            page_.add(watch.name, {kBar, {}, false});
            page_.add(watch.global ? " always " : " ", {kDim, {}, false});
            const int left = page_.columns() - page_.column();
            page_.add_right(shortened(watch.events, left, charset_), {kDim, {}, false});
            page_.next();
        }
    }

    void variables() {
        if (plan_.variables.empty()) return;
        heading(page_, "variables", charset_);
        const int rows = room(plan_.variables.size(), kVariablesMax);
        for (int i = 0; i < rows && i < static_cast<int>(plan_.variables.size()); ++i) {
            const PlanVariableView& variable = plan_.variables[static_cast<size_t>(i)];
            page_.add(shortened(variable.name, page_.columns() / 2, charset_), {});
            page_.add(" ", {});
            const std::string unit = variable.unit.empty() ? "" : " " + variable.unit;
            const int left = page_.columns() - page_.column() - text_width(unit);
            const Ink ink{variable.fresh ? Colour(kFresh) : Colour(), {}, variable.fresh};
            page_.add_right(shortened(variable.value, left, charset_) + unit, ink);
            page_.next();
        }
    }

    void loads() {
        if (plan_.loads.empty()) return;
        heading(page_, "bus " + percent(plan_.load), charset_);
        const int rows = room(plan_.loads.size(), kLoadsMax);
        size_t width = 0;
        double highest = kBarFull;
        for (const NodeLoadView& load : plan_.loads) {
            width = std::max(width, load.name.size());
            highest = std::max(highest, load.share);
        }
        for (int i = 0; i < rows && i < static_cast<int>(plan_.loads.size()); ++i) {
            const NodeLoadView& load = plan_.loads[static_cast<size_t>(i)];
            page_.add(shortened(load.name, page_.columns() / 2, charset_), {});
            page_.jump(static_cast<int>(std::min<size_t>(width, 20)) + 1);
            bar(load.share / highest);
            page_.add_right(percent(load.share), {});
            page_.next();
        }
    }

    void bar(double part) {
        const int columns = static_cast<int>(std::ceil(part * kBarColumns));
        const std::string block = charset_ == Charset::Ascii ? "#" : "━";
        for (int i = 0; i < kBarColumns; ++i) {
            page_.add(block, {i < columns ? Colour(kBar) : Colour(kTrack), {}, false});
        }
    }

    void happenings() {
        heading(page_, "what happened", charset_);
        if (plan_.happenings.empty()) nothing("nothing yet");
        for (const HappeningView& one : plan_.happenings) {
            if (page_.full()) return;
            const double seconds = std::chrono::duration<double>(one.at).count();
            page_.add(fixed(seconds, 1) + " ", {kDim, {}, false});
            const Ink ink{one.fresh ? Colour(kFresh) : Colour(), {}, one.fresh};
            const std::string text = in_charset(one.text, charset_);
            page_.add(shortened(text, page_.columns() - page_.column(), charset_), ink);
            page_.next();
        }
    }

    void nothing(std::string_view words) {
        page_.add(words, {kDim, {}, false});
        page_.next();
    }

    static constexpr Rgb kTrack{60, 65, 75};
    Page page_;
    const PlanPanelView& plan_;
    Charset charset_;
    int reserved_ = 6;  // a heading and a line of each list that follows
};

}  // namespace

void draw_plan_panel(Grid& grid, Area area, const PlanPanelView& plan, const Look& look) {
    PlanPanel(grid, area, plan, look).draw();
}

}  // namespace vagus::cli
