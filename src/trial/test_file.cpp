#include "trial/test_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/file_format.hpp"
#include "base/json_object.hpp"
#include "base/project_border.hpp"
#include "base/text.hpp"
#include "plan/value.hpp"
#include "sim/chaos_file.hpp"
#include "sim/world_file.hpp"

namespace vagus::trial {

namespace {

constexpr double kWholeTurn = 360;

class Reader {
public:
    Reader(TestFile& test, Complaints& complaints) : test_(test), complaints_(complaints) {}

    void read(const JsonValue& json) {
        JsonObject in(json, "the test", complaints_);
        check_format(in, FileFormat::Test);
        test_.help = in.text("help", Need::Optional);
        has_plan_ = json.find("plan") != nullptr || json.find("world") == nullptr;
        test_.plan = path(in, "plan", Need::Optional);
        test_.world = path(in, "world", Need::Optional);
        test_.robot = in.text("robot", Need::Optional);
        for (const JsonValue& one : in.items("scripts", Need::Optional)) {
            file(in, one, "a script, as \"explore.aesl\"", test_.scripts);
        }
        for (const JsonValue& one : in.items("toolboxes", Need::Optional)) {
            file(in, one, "a toolbox, as \"light.toolbox.json\"", test_.toolboxes);
        }
        has_plan_ ? only_without_plan(in, json) : only_with_plan(in, json);
        seeds(in);
        test_.max_time = in.number("max_time", {0.001, kMaxTimeMax, kMaxTimeUnlessSaid});
        values(in);
        starts(in);
        test_.answers = in.find("answers", JsonKind::Object, Need::Optional) != nullptr;
        chaos(in);
        expectations(in);
        in.finish();
        const bool runs_nothing = json.find("plan") == nullptr && json.find("world") == nullptr;
        if (!runs_nothing || !complaints_.empty()) return;
        in.complain(json.at, "the test has no \"plan\" and no \"world\"; add one of them, or both");
    }

private:
    // A path of the file as seen from here.
    std::string beside(JsonObject& in, const JsonValue& value) {
        const Result<std::string> path = path_beside(test_.path, value.text);
        if (path.ok()) return path.value();
        in.complain(value.at, path.error().what);
        return {};
    }

    std::string path(JsonObject& in, std::string_view key, Need need) {
        const JsonValue* const value = in.find(key, JsonKind::String, need);
        return value == nullptr ? "" : beside(in, *value);
    }

    // `what` is what it is the path of, with an example.
    void file(JsonObject& in, const JsonValue& value, std::string_view what,
              std::vector<std::string>& files) {
        if (value.kind != JsonKind::String) {
            return in.complain(value.at, fmt::format("expected the path of {}", what));
        }
        files.push_back(beside(in, value));
    }

    // What says nothing in a test of a world alone is refused, so that nobody waits for it.
    static void only_with_plan(JsonObject& in, const JsonValue& json) {
        static constexpr std::pair<std::string_view, std::string_view> kKeys[] = {
            {"set", "gives values to variables of a plan"},
            {"answers", "says what actors of a plan answer"},
            {"toolboxes", "names templates of a plan"}};
        for (const auto& [key, why] : kKeys) needs_plan(in, json, key, why);
    }

    static void only_without_plan(JsonObject& in, const JsonValue& json) {
        const JsonValue* const scripts = json.find("scripts");
        if (scripts == nullptr || json.find("world") == nullptr) return;
        in.complain(scripts->at,
                    "\"scripts\" of the test are for a test without a \"plan\"; beside a plan "
                    "robots run the scripts that the \"world\" names: name them there");
    }

    static void needs_plan(JsonObject& in, const JsonValue& json, std::string_view key,
                           std::string_view why) {
        const JsonValue* const value = json.find(key);
        if (value == nullptr) return;
        in.complain(value->at,
                    fmt::format("\"{0}\" of {1} {2}, and the test has no \"plan\"; add one, or "
                                "remove \"{0}\"",
                                key, in.name(), why));
    }

    void seeds(JsonObject& in) {
        const JsonValue* const value = in.find("seeds", JsonKind::Array, Need::Optional);
        if (value == nullptr) return;
        const auto good = [](const JsonValue& one) {
            return one.kind == JsonKind::Int && one.integer >= 0;
        };
        if (value->items.size() != 2 || !std::ranges::all_of(value->items, good)) {
            in.complain(value->at,
                        "\"seeds\" of the test: write the first and the last, as [1, 20]");
            return;
        }
        test_.seeds = {static_cast<uint64_t>(value->items[0].integer),
                       static_cast<uint64_t>(value->items[1].integer)};
        const Status fits = check(test_.seeds);
        if (!fits.ok()) in.complain(value->at, "\"seeds\" of the test: " + fits.error().what);
    }

public:
    static Status check(const SeedRange& seeds) {
        if (seeds.last < seeds.first) {
            return Error{Code::BadInput,
                         fmt::format("expected the smaller number first, found {} and {}",
                                     seeds.first, seeds.last)};
        }
        if (seeds.last > kSeedMax) {
            return Error{Code::Limit,
                         fmt::format("expected seeds up to {}, found {}", kSeedMax, seeds.last)};
        }
        if (seeds.last - seeds.first < kSeedsMax) return Status::done();
        return Error{Code::Limit, fmt::format("expected at most {} of them, found {}", kSeedsMax,
                                              seeds.last - seeds.first + 1)};
    }

private:
    void values(JsonObject& in) {
        const JsonValue* const value = in.find("set", JsonKind::Object, Need::Optional);
        if (value == nullptr) return;
        for (const JsonMember& member : value->members) {
            const JsonValue& given = member.value;
            if (given.kind == JsonKind::Bool) {
                test_.set.push_back(member.key + (given.boolean ? "=true" : "=false"));
            } else if (given.is_number() || given.kind == JsonKind::String) {
                test_.set.push_back(member.key + "=" + given.text);
            } else {
                in.complain(given.at, fmt::format("\"set\" of the test: the value of \"{}\" is "
                                                  "{}; write a number, a text, true or false",
                                                  member.key, name_of(given.kind)));
            }
        }
    }

    void starts(JsonObject& in) {
        const JsonValue* const value = in.find("starts", JsonKind::Object, Need::Optional);
        if (value == nullptr) return;
        JsonObject from(*value, "\"starts\"", complaints_);
        Starts starts;
        starts.robot = from.text("robot", Need::Required);
        const JsonValue* const within = from.find("within", JsonKind::Array, Need::Required);
        if (within != nullptr && !corners(*within, starts)) {
            from.complain(within->at,
                          "\"within\" of \"starts\": write two opposite corners in metres, as "
                          "[[0.6, 0.6], [3, 2]]");
        }
        const JsonValue* const angle = from.find("angle", Need::Required);
        if (angle != nullptr && !angles(*angle, starts)) {
            from.complain(angle->at,
                          "\"angle\" of \"starts\": write degrees, as 90, two between which it "
                          "is drawn, as [-30, 30], or \"any\"");
        }
        from.finish();
        test_.starts = starts;
    }

    static bool is_number_below(const JsonValue& value, double limit) {
        return value.is_number() && std::abs(value.number) <= limit;
    }

    static bool corners(const JsonValue& value, Starts& starts) {
        std::vector<double> numbers;
        for (const JsonValue& corner : value.items) {
            if (corner.kind != JsonKind::Array || corner.items.size() != 2) return false;
            for (const JsonValue& one : corner.items) {
                if (!is_number_below(one, sim::kWorldSizeMax * 2)) return false;
                numbers.push_back(one.number);
            }
        }
        if (numbers.size() != 4) return false;
        const auto [x_low, x_high] = std::minmax(numbers[0], numbers[2]);
        const auto [y_low, y_high] = std::minmax(numbers[1], numbers[3]);
        starts.low = {x_low, y_low};
        starts.high = {x_high, y_high};
        return true;
    }

    static bool angles(const JsonValue& value, Starts& starts) {
        if (value.kind == JsonKind::String && value.text == "any") {
            starts.angle_high = kWholeTurn;
            return true;
        }
        if (is_number_below(value, kWholeTurn)) {
            starts.angle_low = starts.angle_high = value.number;
            return true;
        }
        if (value.kind != JsonKind::Array || value.items.size() != 2) return false;
        if (!is_number_below(value.items[0], kWholeTurn)) return false;
        if (!is_number_below(value.items[1], kWholeTurn)) return false;
        starts.angle_low = value.items[0].number;
        starts.angle_high = value.items[1].number;
        return starts.angle_low <= starts.angle_high;
    }

    void chaos(JsonObject& in) {
        const JsonValue* const list = in.find("chaos", JsonKind::Array, Need::Optional);
        if (list == nullptr) return;
        test_.chaos.file = test_.path;
        sim::read_chaos(*list, test_.chaos, complaints_);
        if (!test_.world.empty()) return;
        in.complain(list->at,
                    "\"chaos\" of the test breaks what a world simulates; give the test a "
                    "\"world\"");
    }

    // ---- what is expected ----

    void expectations(JsonObject& in) {
        const JsonValue* const list = in.find("expect", JsonKind::Array, Need::Required);
        if (list == nullptr) return;
        if (list->items.empty()) {
            in.complain(list->at,
                        "\"expect\" of the test is empty: nothing could fail; write what is "
                        "expected, as { \"ends\": \"OK\" }");
        }
        if (list->items.size() > kExpectationsMax) {
            in.complain(list->at, fmt::format("\"expect\" of the test has {} entries; write at "
                                              "most {}",
                                              list->items.size(), kExpectationsMax));
            return;
        }
        for (const JsonValue& one : list->items) expectation(one);
    }

    void expectation(const JsonValue& json) {
        JsonObject in(json, fmt::format("expectation {}", test_.expect.size() + 1), complaints_);
        Expectation made;
        made.at = json.at;
        made.help = in.text("help", Need::Optional);
        if (json.find("order") != nullptr) {
            order(in, made);
            if (!has_plan_) needs_plan(in, json, "order", "names actors of a plan");
        } else if (json.find("ends") != nullptr) {
            made.ends = in.word("ends", ways_to_end(), Need::Required);
            made.by = in.text("by", Need::Optional);
            if (!made.by.empty() && made.ends == "OK") {
                in.complain(json.find("by")->at,
                            fmt::format("\"by\" of {}: a plan that a supervisor ends is never OK; "
                                        "expect Interrupted, or leave \"by\" out",
                                        in.name()));
            }
            if (!has_plan_) ends_without_plan(in, json);
        } else if (json.find("eventually") != nullptr) {
            made.kind = Expectation::Kind::Eventually;
            condition(in, "eventually", made);
            if (in.find("within", Need::Optional) != nullptr) {
                made.within = in.number("within", {0, kWithinMax, kWithinMax});
            }
        } else if (json.find("always") != nullptr) {
            made.kind = Expectation::Kind::Always;
            condition(in, "always", made);
        } else if (json.find("never") != nullptr) {
            made.kind = Expectation::Kind::Never;
            condition(in, "never", made);
        } else if (json.kind == JsonKind::Object) {
            in.complain(json.at, in.name() +
                                     " expects nothing; write \"order\", \"eventually\", "
                                     "\"always\", \"never\" or \"ends\"");
            return;
        }
        in.finish();
        test_.expect.push_back(std::move(made));
    }

    static void order(JsonObject& in, Expectation& made) {
        made.kind = Expectation::Kind::Order;
        const JsonValue* const list = in.find("order", JsonKind::Array, Need::Required);
        if (list == nullptr) return;
        const bool fits = !list->items.empty() && list->items.size() <= kOrderMax;
        if (!fits) {
            in.complain(list->at, fmt::format("\"order\" of {}: write 1 to {} names of actors, "
                                              "found {}",
                                              in.name(), kOrderMax, list->items.size()));
        }
        for (const JsonValue& one : list->items) {
            if (one.kind == JsonKind::String) {
                made.order.push_back(one.text);
            } else {
                in.complain(one.at, fmt::format("\"order\" of {}: write the name of an actor in "
                                                "quotes, found {}",
                                                in.name(), name_of(one.kind)));
            }
        }
    }

    // Scripts have no end of their own.
    static void ends_without_plan(JsonObject& in, const JsonValue& json) {
        needs_plan(in, json, "by", "names a supervisor of a plan");
        const JsonValue* const ends = json.find("ends");
        if (ends->text == kEndsMaxTime) return;
        in.complain(ends->at, fmt::format("\"ends\" of {}: without a \"plan\" a run ends only when "
                                          "its \"max_time\" is over; write \"{}\"",
                                          in.name(), kEndsMaxTime));
    }

    void condition(JsonObject& in, std::string_view key, Expectation& made) const {
        const JsonValue* const value = in.find(key, JsonKind::String, Need::Required);
        if (value == nullptr) return;
        const Status good = parse(value->text, made);
        if (good.ok()) return;
        in.complain(value->at, fmt::format("\"{}\" of {}: {}", key, in.name(), good.error().what));
    }

    // What is of a plan is known only with that.
    Status parse(const std::string& text, Expectation& made) const {
        made.condition = TRY(Condition::parse(text));
        return has_plan_ ? Status::done() : made.condition->bind_without_plan();
    }

    TestFile& test_;
    Complaints& complaints_;
    bool has_plan_ = true;
};

std::string quoted_names(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

}  // namespace

const std::vector<std::string_view>& ways_to_end() {
    static const std::vector<std::string_view> kWays = {"OK", "Interrupted", "Error", kEndsMaxTime};
    return kWays;
}

std::string text_of(const Expectation& expectation) {
    switch (expectation.kind) {
        case Expectation::Kind::Order:
            return "order " + quoted_names(expectation.order);
        case Expectation::Kind::Eventually:
            return fmt::format("eventually \"{}\"{}", expectation.condition->text(),
                               expectation.within
                                   ? fmt::format(" within {} s", plan::text_of(*expectation.within))
                                   : "");
        case Expectation::Kind::Always:
            return fmt::format("always \"{}\"", expectation.condition->text());
        case Expectation::Kind::Never:
            return fmt::format("never \"{}\"", expectation.condition->text());
        case Expectation::Kind::Ends:
            break;
    }
    return "ends " + expectation.ends + (expectation.by.empty() ? "" : " by " + expectation.by);
}

Result<TestFile> read_test(std::string_view text, const std::string& path) {
    const JsonValue json = TRY(parse_format(text, path, FileFormat::Test));
    TestFile test{.path = path};
    Complaints complaints;
    Reader(test, complaints).read(json);
    if (!complaints.empty()) return first_complaint(complaints, path);
    return test;
}

Result<SeedRange> parse_seeds(const std::string& text) {
    const size_t dots = text.find("..");
    const auto first = decimal_number(text.substr(0, dots));
    const auto last = dots == std::string::npos ? first : decimal_number(text.substr(dots + 2));
    if (!first || !last) {
        return Error{Code::BadInput, fmt::format("--seeds {}: expected one number, or the first "
                                                 "and the last, as --seeds 1..20",
                                                 text)};
    }
    const SeedRange seeds{*first, *last};
    const Status fits = Reader::check(seeds);
    if (!fits.ok()) {
        return Error{fits.error().code, fmt::format("--seeds {}: {}", text, fits.error().what)};
    }
    return seeds;
}

}  // namespace vagus::trial
