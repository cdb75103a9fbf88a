#include "trial/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace vagus::trial {

namespace {

// Pixels. Places of a plan file are further apart here: each box has a row for each way out.
constexpr double kScaleX = 1.35, kScaleY = 1.45;
constexpr double kWidth = 220, kHead = 28, kRow = 19, kMargin = 40;
constexpr double kStep = 240;    // between boxes that have no place
constexpr size_t kRowText = 26;  // characters of a row, without its count

constexpr const char* kTaken = "#1a7f37";
constexpr const char* kNever = "#c0392b";

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '<') {
            out += "&lt;";
        } else if (c == '&') {
            out += "&amp;";
        } else {
            out += c;
        }
    }
    return out;
}

struct Row {
    std::string text;
    std::string target;  // an actor; else "@terminate", "@ignore"
    uint64_t count = 0;
};

struct Box {
    std::string name = {};
    double x = 0, y = 0;
    uint64_t count = 0;
    std::vector<Row> rows = {};

    double height() const { return kHead + kRow * static_cast<double>(rows.size()); }
    double row_y(size_t i) const { return y + kHead + kRow * (static_cast<double>(i) + 0.5); }
};

uint64_t count_of(const PlanCoverage::Counts& counts, const std::string& name) {
    const auto found = counts.find(name);
    return found == counts.end() ? 0 : found->second;
}

class Drawing {
public:
    Drawing(const plan::Plan& plan, const PlanCoverage& coverage)
        : plan_(plan), coverage_(coverage) {}

    std::string draw() {
        make_boxes();
        std::string body;
        for (const Box& box : boxes_) {
            for (size_t i = 0; i < box.rows.size(); ++i) body += arrow(box, i);
        }
        for (const Box& box : boxes_) body += draw(box);
        double left = 0, top = 0, right = 0, bottom = 0;
        for (const Box& box : boxes_) {
            left = std::min(left, box.x);
            top = std::min(top, box.y);
            right = std::max(right, box.x + kWidth);
            bottom = std::max(bottom, box.y + box.height());
        }
        return fmt::format(
            "{}\"{:.0f} {:.0f} {:.0f} {:.0f}\" "
            "font-family=\"sans-serif\" font-size=\"12\">\n<title>{}: what the runs went "
            "through</title>\n<defs>{}{}</defs>\n<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"100%\" "
            "height=\"100%\" fill=\"#ffffff\"/>\n{}</svg>\n",
            kDrawingBegins, left - kMargin, top - kMargin, right - left + 2 * kMargin,
            bottom - top + 2 * kMargin, escaped(plan_.name), marker("taken", kTaken),
            marker("never", kNever), left - kMargin, top - kMargin, body);
    }

private:
    static std::string marker(std::string_view id, std::string_view colour) {
        return fmt::format(
            "<marker id=\"{}\" viewBox=\"0 0 8 8\" refX=\"8\" refY=\"4\" markerWidth=\"8\" "
            "markerHeight=\"8\" orient=\"auto\"><path d=\"M0 0L8 4L0 8z\" "
            "fill=\"{}\"/></marker>",
            id, colour);
    }

    void place(Box& box, const std::string& spot) {
        const auto found = std::ranges::find(plan_.layout, spot, &plan::Spot::name);
        if (found != plan_.layout.end()) {
            box.x = found->x * kScaleX;
            box.y = found->y * kScaleY;
        } else {
            box.x = kStep * static_cast<double>(unplaced_++);
            box.y = -kStep;
        }
    }

    void add_events(Box& box, const std::string& prefix, const plan::Supervisor& supervisor) {
        for (const plan::Rule& rule : supervisor.events) {
            const uint64_t count =
                count_of(coverage_.events, prefix + supervisor.name + ": " + rule.name);
            box.rows.push_back({supervisor.name + ": " + rule.name, rule.target, count});
        }
    }

    void make_boxes() {
        if (!plan_.globals.empty()) {
            Box start{.name = "start"};
            for (const plan::Supervisor& one : plan_.globals) add_events(start, "", one);
            for (const Row& row : start.rows) start.count += row.count;
            place(start, "@start");
            boxes_.push_back(std::move(start));
        }
        for (const plan::Actor& actor : plan_.actors) {
            Box box{.name = actor.name, .count = count_of(coverage_.actors, actor.name)};
            for (const plan::Rule& rule : actor.states) {
                box.rows.push_back({rule.name, rule.target,
                                    count_of(coverage_.states, actor.name + ": " + rule.name)});
            }
            for (const plan::Supervisor& one : actor.supervisors) {
                add_events(box, actor.name + ".", one);
            }
            place(box, actor.name);
            boxes_.push_back(std::move(box));
        }
    }

    std::string arrow(const Box& from, size_t i) const {
        const Row& row = from.rows[i];
        const auto to = std::ranges::find(boxes_, row.target, &Box::name);
        if (to == boxes_.end()) return {};
        const bool taken = row.count > 0;
        const bool ahead = to->x >= from.x + kWidth;
        const double x0 = ahead ? from.x + kWidth : from.x;
        const double y0 = from.row_y(i);
        const double x1 = to->x + (ahead ? 0 : kWidth);
        const double y1 = to->y + kHead / 2;
        const double bend = ahead ? 50 : -50;
        return fmt::format(
            "<path d=\"M{:.0f} {:.0f}C{:.0f} {:.0f} {:.0f} {:.0f} {:.0f} {:.0f}\" fill=\"none\" "
            "stroke=\"{}\" stroke-width=\"{}\"{} marker-end=\"url(#{})\"/>\n",
            x0, y0, x0 + bend, y0, x1 - bend, y1, x1, y1, taken ? kTaken : kNever, taken ? 2 : 1,
            taken ? "" : " stroke-dasharray=\"4 4\"", taken ? "taken" : "never");
    }

    static std::string text(double x, double y, const char* colour, std::string_view anchor,
                            std::string_view style, std::string_view content) {
        return fmt::format(
            "<text x=\"{:.0f}\" y=\"{:.0f}\" fill=\"{}\" text-anchor=\"{}\"{}>{}"
            "</text>\n",
            x, y, colour, anchor, style, escaped(content));
    }

    static std::string draw(const Box& box) {
        const char* const colour = box.count > 0 ? kTaken : kNever;
        std::string out = fmt::format(
            "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" rx=\"6\" "
            "fill=\"{}\" stroke=\"{}\" stroke-width=\"1.5\"/>\n",
            box.x, box.y, kWidth, box.height(), box.count > 0 ? "#eefaf0" : "#fdf0ee", colour);
        out += text(box.x + 10, box.y + 19, "#1f2328", "start", " font-weight=\"bold\"", box.name);
        out += text(box.x + kWidth - 10, box.y + 19, colour, "end", "", std::to_string(box.count));
        for (size_t i = 0; i < box.rows.size(); ++i) {
            const Row& row = box.rows[i];
            const char* const its = row.count > 0 ? kTaken : kNever;
            std::string shown = row.text;
            if (shown.size() > kRowText) shown = shown.substr(0, kRowText - 1) + "…";
            out += text(box.x + 10, box.row_y(i) + 4, its, "start", "", shown);
            out += text(box.x + kWidth - 10, box.row_y(i) + 4, its, "end", "",
                        std::to_string(row.count));
        }
        return out;
    }

    const plan::Plan& plan_;
    const PlanCoverage& coverage_;
    std::vector<Box> boxes_;
    size_t unplaced_ = 0;
};

}  // namespace

std::string draw_coverage(const plan::Plan& plan, const PlanCoverage& coverage) {
    return Drawing(plan, coverage).draw();
}

}  // namespace vagus::trial
