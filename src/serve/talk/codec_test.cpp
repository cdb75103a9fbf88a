// Every message, walked by its own list of fields: what is written is read again, and whatever is
// done to one field is refused with a sentence that names it.
#include "serve/talk/codec.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "serve/follow/record.hpp"
#include "serve/json.hpp"
#include "serve/talk/reader.hpp"
#include "serve/talk/writer.hpp"

namespace vagus::serve::talk {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// ---- a sample of each message, no field as it is by default ----

BusFrame frame() {
    BusFrame frame;
    frame.frame.source = 3;
    frame.frame.type = 0x8000;
    frame.frame.size = 2;
    frame.frame.payload[0] = 7;
    return frame;
}

BreakpointOrder breakpoint() {
    return {4, "W.plan.json", BreakpointKind::State, "go", "Done", "n > 2", 3, false};
}

std::vector<Order> orders() {
    return {
        Open{.order = 5,
             .world = "hall.world.json",
             .plan = "W.plan.json",
             .toolboxes = {"a.toolbox.json", "b.so"},
             .set = {{"n", "3"}, {"s", "”text“"}},
             .breakpoints = {breakpoint()},
             .robot = "alice",
             .from = "go",
             .bus = "tcp:localhost:33333",
             .project = "p.aesl",
             .poses = {{1, 2, 3}, {4, 5, 6}}},
        SetPace{false, 2.5},
        LetTimePass{40},
        Show{true, {"alice", "bob"}},
        StepPlan{},
        StopPlan{},
        HoldNodes{{1, 4}},
        SetBreakpoints{{breakpoint()}},
        SetVariable{1, 2, "n", plan::Value(int64_t{-7})},
        RaiseEvent{2, "s", "e", {{"a", plan::Value(true)}, {"b", plan::Value(1.5)}}},
        HandleHeld{3, HeldAct::Drop, 9},
        ChangePlan{4, {"a", "b"}},
        CheckPlan{5, {{"a", "{}"}}},
        MoveRobot{6, "alice", {1, 2}, 0.5},
        MoveObject{7, 12, {1, 2}, 0.5},
        PutObject{8,
                  ObjectKind::Light,
                  {1, 2},
                  3,
                  "lamp",
                  Point{4, 5},
                  6,
                  7,
                  8,
                  Colour{1, 0.5, 0},
                  false},
        TakeObject{9, 12},
        SwitchLight{10, 12, true},
        PressButton{11, "alice", "centre", true},
        TapRobot{12, "alice"},
        SendFrame{frame()},
        ScriptLoaded{3, "/home/me/carbot.aesl", "var x\n"},
        FlushRecording{13},
        HearOfFleet{"alarm", "r2", {7, -32768}},
    };
}

Scene scene() {
    return {{{"alice", {1, 2}}}, {{{"robots", Json::array({1, -2, 2.5, nullptr, true, "x"})}}}};
}

std::string record() {
    RecordWriter writer;
    writer.begin(1);
    writer.pose(7, 1, 2, 3);
    return writer.take();
}

std::vector<News> news() {
    PlanOutline plan;
    plan.file = "W.plan.json";
    plan.name = "W";
    plan.configuration = {{"n", "int", "cm"}};
    plan.globals = {{"guard", {"Received", "Timeout"}}};
    plan.actors = {{"go", "sub.plan.json", "folder/sub.plan.json", {{"near", {"Near"}}}}};
    return {
        Alive{},
        Opening{3},
        Opened{4, scene(), {{3, "var n"}}, {"told"}, {"stop"}},
        OpenFailed{5, "no"},
        PlanVersion{2, {plan}, {{"W.plan.json", "{}"}}},
        Traced{"{}", "go", true},
        PlanNow{PlanState::Ended,
                2.5,
                "W.plan.json",
                {{"W.plan.json", {{{"path", "W"}}}}},
                {Json::array({{{"text", "x"}}})},
                "Error",
                "why",
                {4, 5}},
        HeldNow{{{{"stands", true}}}},
        BreakpointsNow{{{4, 2, true, "why"}}},
        PlanOver{},
        Answer{6, "why", 12, std::vector<std::string>{"a", "b"}},
        Line{LineKind::Warning, "text"},
        Clock{1.5, false, 0.9, 12.5},
        SceneNow{scene()},
        FrameSeen{1.5, frame()},
        Poses{1.5, {std::string("\0\1", 2)}},
        Rays{1.5, {"rays"}},
        Picture{1.5, "alice", {"pixels"}},
        Records{{record()}},
        HappenedNow{{{{.t = 1.5,
                       .kind = "state",
                       .node = 3,
                       .source = "drive",
                       .name = "paused",
                       .text = "line 12",
                       .args = {-32768, 7, 32767},
                       .line = 12}}}},
        PictureThen{1.5, "alice", {"pixels"}},
        ToldFleet{"n", {-32768, 7}},
    };
}

Result<Order> decode_again(const Order&, const Packet& packet) {
    return decode_order(packet);
}
Result<News> decode_again(const News&, const Packet& packet) {
    return decode_news(packet);
}

// ---- what is done to a field ----

enum class Harm { Missing, Null, OtherKind };

// Of a kind that no field of a message has at its top: bytes where something else is expected, and
// the other way round.
template <typename T>
constexpr bool kIsBytes = std::is_same_v<T, Bytes> || std::is_same_v<T, BusFrame>;
template <typename T>
constexpr bool kMayBeNothing = std::is_same_v<T, plan::Value>;
template <typename T>
constexpr bool kMayBeNothing<std::optional<T>> = true;

// Writes a message, one of its fields wrongly. That field's name.
class Spoiler {
public:
    Spoiler(size_t at, Harm harm) : at_(at), harm_(harm) {}

    template <typename T>
    void operator()(std::string_view name, const T& value) {
        if (next_++ != at_) return writer_(name, value);
        name_ = name;
        can_be_ = harm_ == Harm::Null && kMayBeNothing<T>;
        if (harm_ == Harm::Null) writer_(name, std::optional<bool>());
        if (harm_ == Harm::OtherKind && kIsBytes<T>) writer_(name, true);
        if (harm_ == Harm::OtherKind && !kIsBytes<T>) writer_(name, Bytes{"x"});
    }
    std::string take() { return writer_.take(); }
    // Empty: the message has fewer fields.
    const std::string& name() const { return name_; }
    // What was done is allowed there.
    bool can_be() const { return can_be_; }

private:
    Writer writer_;
    const size_t at_;
    const Harm harm_;
    size_t next_ = 0;
    std::string name_;
    bool can_be_ = false;
};

template <typename List>
std::string_view name_of(const List& message) {
    return std::visit([](const auto& one) { return std::decay_t<decltype(one)>::kName; }, message);
}

template <typename List>
void check_harm(const List& message, Harm harm) {
    Packet packet = encode(message);
    for (size_t at = 0;; ++at) {
        Spoiler spoiler(at, harm);
        std::visit([&](const auto& one) { std::decay_t<decltype(one)>::layout(spoiler, one); },
                   message);
        if (spoiler.name().empty()) return;
        packet.bytes = spoiler.take();
        const auto read = decode_again(message, packet);
        const std::string field = std::string(name_of(message)) + "." + spoiler.name();
        EXPECT_EQ(read.ok(), spoiler.can_be()) << field;
        if (read.ok()) continue;
        EXPECT_THAT(read.error().what, StartsWith(field + ": expected "));
        EXPECT_THAT(read.error().what, HasSubstr(", found "));
    }
}

template <typename List>
void check_message(const List& message) {
    const Packet packet = encode(message);
    const auto read = decode_again(message, packet);
    ASSERT_TRUE(read.ok()) << read.error().what;
    EXPECT_EQ(read.value(), message) << name_of(message);
    for (const Harm harm : {Harm::Missing, Harm::Null, Harm::OtherKind}) check_harm(message, harm);
    // Cut anywhere, and with something behind its end.
    for (size_t size = 0; size < packet.bytes.size(); ++size) {
        const auto cut = decode_again(message, {packet.kind, packet.bytes.substr(0, size)});
        ASSERT_FALSE(cut.ok()) << name_of(message) << " cut to " << size;
        EXPECT_THAT(cut.error().what, StartsWith(std::string(name_of(message))));
    }
    EXPECT_FALSE(decode_again(message, {packet.kind, packet.bytes + "n"}).ok());
}

TEST(Talk, EveryOrderIsReadAsItWasWrittenAndNothingElse) {
    const std::vector<Order> all = orders();
    ASSERT_EQ(all.size(), std::variant_size_v<Order>);
    for (size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].index(), i);
        check_message(all[i]);
    }
}

TEST(Talk, EveryMessageOfARunIsReadAsItWasWrittenAndNothingElse) {
    const std::vector<News> all = news();
    ASSERT_EQ(all.size(), std::variant_size_v<News>);
    for (size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].index(), i);
        check_message(all[i]);
    }
}

TEST(Talk, ASentenceNamesThePlaceInside) {
    Open open;
    open.breakpoints = {breakpoint(), breakpoint()};
    Packet packet = encode(Order(open));
    const size_t at = packet.bytes.rfind("state");
    packet.bytes.replace(at, 5, "stole");
    EXPECT_EQ(decode_order(packet).error().what,
              "open.breakpoints[1].kind: expected one of actor, state, event, condition, found "
              "“stole”");
}

TEST(Talk, ANumberOutsideOfItsFieldIsRefused) {
    Writer writer;
    writer("request", uint64_t{1});
    writer("object", uint64_t{1} << 32);
    const Packet take{encode(Order(TakeObject{})).kind, writer.take()};
    EXPECT_EQ(decode_order(take).error().what,
              "object.take.object: expected a number up to 4294967295, found 4294967296");
}

TEST(Talk, AWordIsAWordOfANode) {
    Packet packet = encode(News(HappenedNow{{{{.args = {-1}}}}}));
    const size_t at = packet.bytes.rfind("\xff\xff\xff\xff\xff\xff\xff\xff");
    ASSERT_NE(at, std::string::npos);
    // -32,769, as 64 bits, the lowest first.
    packet.bytes.replace(at, 8, "\xff\x7f\xff\xff\xff\xff\xff\xff");
    const auto read = decode_news(packet);
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().what,
              "happened.list[0].args[0]: expected a number from -32768 to 32767, found -32769");
}

TEST(Talk, WhatIsNotFiniteIsNoNumber) {
    const double odd[] = {std::numeric_limits<double>::quiet_NaN(),
                          std::numeric_limits<double>::infinity()};
    for (const double one : odd) {
        const auto read = decode_news(encode(News(Clock{.t = one})));
        ASSERT_FALSE(read.ok());
        EXPECT_THAT(read.error().what, StartsWith("clock.t: expected a finite number, found "));
    }
    // In a document it is null, as in any JSON.
    const auto read = decode_news(encode(News(HeldNow{{{{"t", odd[0]}}}})));
    ASSERT_TRUE(read.ok());
    EXPECT_TRUE(std::get<HeldNow>(read.value()).document.json["t"].is_null());
}

// Names of files may be any bytes; pages are told text only.
TEST(Talk, TextThatIsNotUtf8IsReplacedBeforeItTravelsAndRefusedAfter) {
    const Packet packet = encode(News(Line{LineKind::Note,
                                           "a\xff"
                                           "b"}));
    const auto read = decode_news(packet);
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(std::get<Line>(read.value()).text,
              "a\xef\xbf\xbd"
              "b");
    Packet bad = packet;
    bad.bytes[bad.bytes.size() - 2] = '\xff';
    EXPECT_THAT(decode_news(bad).error().what, StartsWith("line.text: expected UTF-8, found "));
}

TEST(Talk, ADocumentIsAsDeepAsItMayBeAndNoDeeper) {
    const auto nested = [](int levels) {
        Json json = Json::object();
        for (int i = 0; i < levels; ++i) json = Json{{"a", std::move(json)}};
        return decode_news(encode(News(HeldNow{{std::move(json)}})));
    };
    EXPECT_TRUE(nested(kJsonDepthMax).ok());
    EXPECT_THAT(nested(kJsonDepthMax + 1).error().what,
                HasSubstr("held.document: expected at most 64 levels, found one more"));
}

// What is announced costs nothing until it is there.
TEST(Talk, AListIsAsLongAsItMayBeAndNoLonger) {
    const auto long_list = [](size_t count, size_t there) {
        Packet packet = encode(Order(ChangePlan{}));
        packet.bytes.resize(packet.bytes.size() - sizeof(uint32_t));
        const auto announced = static_cast<uint32_t>(count);
        packet.bytes.append(reinterpret_cast<const char*>(&announced), sizeof announced);
        packet.bytes.append(there, '\0');
        return decode_order(packet).error().what;
    };
    EXPECT_EQ(long_list(kItemsMax, 0), "plan.change.files: expected 1048576 items, found its end");
    EXPECT_EQ(long_list(kItemsMax + 1, kItemsMax + 1),
              "plan.change.files: expected at most 1048576 items, found 1048577");
    EXPECT_THAT(long_list(kItemsMax, kItemsMax),
                StartsWith("plan.change.files[0]: expected a text, found "));
}

TEST(Talk, AFrameIsOneWholeFrame) {
    // 65,536 bytes: as a number of 16 bits none at all.
    for (const size_t size : {size_t{0}, size_t{1}, size_t{wire::kFrameMax} + 1, size_t{65'536}}) {
        Writer writer;
        writer("frame", Bytes{std::string(size, '\0')});
        const Packet packet{encode(Order(SendFrame{})).kind, writer.take()};
        EXPECT_THAT(decode_order(packet).error().what,
                    StartsWith("frame.frame: expected a whole frame of the bus, found "));
    }
}

TEST(Talk, ValuesOfAPlanTravelAsTheyAre) {
    for (const plan::Value& value : {plan::Value(false), plan::Value(int64_t{-3}), plan::Value(2.0),
                                     plan::Value(std::string("3")), plan::Value(plan::Object{})}) {
        const auto read = decode_order(encode(Order(SetVariable{1, 0, "n", value})));
        ASSERT_TRUE(read.ok());
        EXPECT_EQ(std::get<SetVariable>(read.value()).value, value);
    }
}

}  // namespace
}  // namespace vagus::serve::talk
