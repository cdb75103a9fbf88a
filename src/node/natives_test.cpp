#include "node/natives.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "node/fixed_math.hpp"
#include "node/test_node.hpp"
#include "wire/messages.hpp"

namespace vagus::node {
namespace {

using testing::ElementsAre;

constexpr uint16_t kBase = 100;  // variables that the tests use begin here
using Words = std::vector<int16_t>;

// A call made as compiled code makes it: pushes sizes (last first), then addresses (last first),
// then the native.
class Call {
public:
    explicit Call(const std::string& name) : id_(id_of(name)) {}

    Call& put(uint16_t address, const Words& words) {
        std::copy(words.begin(), words.end(), test.variables.begin() + address);
        return *this;
    }
    // Gives the message of the fault, as hex; empty if there was none.
    std::string run(const std::vector<int>& addresses, const std::vector<int>& sizes = {}) {
        std::vector<uint16_t> code = {3, isa::kInitEvent, 3};
        push(code, sizes);
        push(code, addresses);
        code.push_back(isa::instruction(isa::Opcode::Native, id_));
        code.push_back(0);
        std::copy(code.begin(), code.end(), test.bytecode.begin());
        vm::start_event(test.node.vm, isa::kInitEvent);
        node::run(test.node, 1000);
        left_on_stack = test.node.vm.depth;
        return test.take();
    }
    Words words(uint16_t address, int count) const {
        return {test.variables.begin() + address, test.variables.begin() + address + count};
    }

    TestNode test;
    int left_on_stack = -1;

private:
    static uint16_t id_of(const std::string& name) {
        for (uint16_t id = 0; id < kStandardNativeCount; ++id) {
            if (name == kStandardNatives[id].name) return id;
        }
        ADD_FAILURE() << "no native " << name;
        return kStandardNativeCount;
    }
    static void push(std::vector<uint16_t>& code, const std::vector<int>& values) {
        for (auto value = values.rbegin(); value != values.rend(); ++value) {
            code.push_back(isa::instruction(isa::Opcode::LargeImm, 0));
            code.push_back(static_cast<uint16_t>(*value));
        }
    }
    uint16_t id_;
};

// One result of a function of one or two scalars: dest at 100, operands at 101 and 102.
int16_t of(const std::string& name, int16_t x) {
    Call call(name);
    EXPECT_EQ(call.put(101, {x}).run({100, 101}, {1}), "");
    return call.words(100, 1)[0];
}
int16_t of(const std::string& name, int16_t left, int16_t right) {
    Call call(name);
    EXPECT_EQ(call.put(101, {left, right}).run({100, 101, 102}, {1}), "");
    return call.words(100, 1)[0];
}

// ---- Appendix C of the specification ----

TEST(Natives, SineHasTheMeasuredValues) {
    EXPECT_EQ(of("math.sin", 0), 0);
    EXPECT_EQ(of("math.sin", 1), 3);
    EXPECT_EQ(of("math.sin", 64), 201);
    EXPECT_EQ(of("math.sin", 8192), 23171);
    EXPECT_EQ(of("math.sin", 16384), 32767);
    EXPECT_EQ(of("math.sin", -16384), -32767);
    EXPECT_EQ(of("math.sin", 32767), 3);
    EXPECT_EQ(of("math.sin", -32768), 0);
}

TEST(Natives, CosineHasTheMeasuredValues) {
    EXPECT_EQ(of("math.cos", 0), 32767);
    EXPECT_EQ(of("math.cos", 8192), 23171);
    EXPECT_EQ(of("math.cos", 16384), 0);
    EXPECT_EQ(of("math.cos", -32768), -32767);
}

// The table is not a rounded sine, but never far from one; and a sine is odd and symmetric about a
// quarter turn.
TEST(Natives, SineIsOddSymmetricAndNearTheRealOne) {
    for (int32_t angle = -32768; angle <= 32767; ++angle) {
        const int16_t a = static_cast<int16_t>(angle);
        const int16_t sine = fixed_sin(a);
        if (angle != -32768) {
            ASSERT_EQ(fixed_sin(static_cast<int16_t>(-angle)), -sine) << angle;
        }
        if (angle >= 1) {
            ASSERT_EQ(fixed_sin(wrap16(static_cast<uint32_t>(32768 - angle))), sine) << angle;
        }
        ASSERT_NEAR(sine, 32767 * std::sin(angle * M_PI / 32768), 6.0) << angle;
        ASSERT_EQ(fixed_cos(a), fixed_sin(wrap16(static_cast<uint32_t>(angle + 16384)))) << angle;
    }
}

TEST(Natives, Atan2HasTheMeasuredValues) {
    const int16_t vectors[][3] = {{0, 0, 0},
                                  {0, -5, -32768},
                                  {1, 0, 16384},
                                  {-1, 0, -16384},
                                  {1, 1, 8203},
                                  {1, -1, 24565},
                                  {-1, -1, -24565},
                                  {-1, 1, -8203},
                                  {1, 32767, 0},
                                  {100, 3, 16071},
                                  {3, 100, 312},
                                  {-32768, 1, -16384},
                                  {-32768, -32768, -24565},
                                  {5, -32768, 16384},
                                  {1, -32768, 16384}};
    for (const auto& [y, x, angle] : vectors) {
        EXPECT_EQ(of("math.atan2", y, x), angle) << y << ' ' << x;
    }
}

TEST(Natives, Atan2IsNearTheRealOne) {
    for (int y = -3000; y <= 3000; y += 37) {
        for (int x = -3000; x <= 3000; x += 41) {
            if (x == 0 && y == 0) continue;
            const double angle = std::atan2(y, x) * 32768 / M_PI;
            const int16_t found = fixed_atan2(static_cast<int16_t>(y), static_cast<int16_t>(x));
            const double off = std::remainder(found - angle, 65536.0);
            ASSERT_LE(std::abs(off), 90) << y << ' ' << x;
        }
    }
}

int16_t dot(const Words& left, const Words& right, int16_t shift) {
    Call call("math.dot");
    const int size = static_cast<int>(left.size());
    EXPECT_EQ(
        call.put(110, left).put(120, right).put(130, {shift}).run({100, 110, 120, 130}, {size}),
        "");
    return call.words(100, 1)[0];
}

TEST(Natives, DotHasTheMeasuredValues) {
    const Words left = {1000, -2000, 3000};
    const Words right = {20000, 4, 30000};
    EXPECT_EQ(dot(left, right, 0), 22592);
    EXPECT_EQ(dot(left, right, 2), -27120);
    EXPECT_EQ(dot(left, right, 14), 6713);
    EXPECT_EQ(dot(left, right, 27), 0);
    EXPECT_EQ(dot(left, right, 32), 22592);
    EXPECT_EQ(dot(left, right, 33), 0);
    EXPECT_EQ(dot(left, right, -1), 0);
    EXPECT_EQ(dot({32767, 32767, 32767}, {32767, 32767, 32767}, 15), 32762);
}

TEST(Natives, MuldivHasTheMeasuredValues) {
    Call call("math.muldiv");
    call.put(110, {-32768, 32767, -1000, 7, 1000})
        .put(120, {-32768, 32767, 1000, -1, 1000})
        .put(130, {-1, 1, 3, 2, 3});
    EXPECT_EQ(call.run({100, 110, 120, 130}, {5}), "");
    EXPECT_THAT(call.words(100, 5), ElementsAre(0, 1, -5653, -3, 5653));
}

TEST(Natives, ClampLooksAtTheUpperLimitFirst) {
    Call call("math.clamp");
    call.put(110, {5, -5, 7, 100}).put(120, {10, 10, 0, 0}).put(130, {0, 0, 10, 10});
    EXPECT_EQ(call.run({100, 110, 120, 130}, {4}), "");
    EXPECT_THAT(call.words(100, 4), ElementsAre(0, 10, 7, 10));
}

TEST(Natives, ArgboundsGivesTheFirstOfEquals) {
    Call call("math.argbounds");
    EXPECT_EQ(call.put(110, {5, 1, 5, 1}).run({110, 100, 101}, {4}), "");
    EXPECT_THAT(call.words(100, 2), ElementsAre(1, 0));
}

TEST(Natives, ArgboundsLeavesOutputsThatNoElementCanReach) {
    Call low("math.argbounds");
    low.put(100, {77, 88}).put(110, {-32768, -32768}).run({110, 100, 101}, {2});
    EXPECT_THAT(low.words(100, 2), ElementsAre(0, 88));
    Call high("math.argbounds");
    high.put(100, {77, 88}).put(110, {32767, 32767}).run({110, 100, 101}, {2});
    EXPECT_THAT(high.words(100, 2), ElementsAre(77, 0));
}

TEST(Natives, RandStartsAtZeroInEveryNode) {
    for (int node = 0; node < 2; ++node) {
        Call call("math.rand");
        EXPECT_EQ(call.run({100}, {6}), "");
        EXPECT_THAT(call.words(100, 6), ElementsAre(13849, -16794, 31223, 17180, 13925, -4190));
    }
}

// ---- Vectors ----

TEST(Natives, CopyWritesAsItGoes) {
    Call call("math.copy");
    EXPECT_EQ(call.put(100, {1, 2, 3, 4, 5}).run({101, 100}, {4}), "");
    EXPECT_THAT(call.words(100, 5), ElementsAre(1, 1, 1, 1, 1));
}

TEST(Natives, FillReadsItsValueAnewAndAddscalarDoesNot) {
    Call fill("math.fill");
    fill.put(100, {1, 2, 3}).run({100, 101}, {3});
    EXPECT_THAT(fill.words(100, 3), ElementsAre(2, 2, 2));
    Call add("math.addscalar");
    add.put(100, {1, 2, 3}).run({100, 100, 101}, {3});
    EXPECT_THAT(add.words(100, 3), ElementsAre(3, 4, 5));
}

TEST(Natives, ArithmeticWraps) {
    EXPECT_EQ(of("math.add", 32767, 1), -32768);
    EXPECT_EQ(of("math.sub", -32768, 1), 32767);
    EXPECT_EQ(of("math.mul", 300, 300), 24464);
    EXPECT_EQ(of("math.mul", -32768, -32768), 0);
    EXPECT_EQ(of("math.div", -32768, -1), -32768);
    EXPECT_EQ(of("math.div", -7, 2), -3);
    EXPECT_EQ(of("math.min", -3, 2), -3);
    EXPECT_EQ(of("math.max", -3, 2), 2);
}

TEST(Natives, DivisionByZeroKeepsWhatIsWrittenAndPopsEverything) {
    for (const char* name : {"math.div", "math.muldiv"}) {
        Call call(name);
        const bool four = std::string(name) == "math.muldiv";
        call.put(110, {8, 8, 8}).put(120, {2, 0, 4}).put(130, {4, 0, 4});
        const std::string fault =
            four ? call.run({100, 110, 120, 130}, {3}) : call.run({100, 110, 120}, {3});
        // The calls push 5 and 4 words of two each behind the table: the native is at 13 and 11.
        EXPECT_EQ(fault, four ? "02 00 01 00 07 90 0d 00" : "02 00 01 00 07 90 0b 00");
        EXPECT_THAT(call.words(100, 3), ElementsAre(4, 0, 0));
        EXPECT_EQ(call.left_on_stack, 0);
        EXPECT_EQ(call.test.node.vm.flags, wire::kFlagStep);
    }
}

TEST(Natives, StatTruncatesTheMean) {
    Call call("math.stat");
    EXPECT_EQ(call.put(110, {-7, 2, -2}).run({110, 100, 101, 102}, {3}), "");
    EXPECT_THAT(call.words(100, 3), ElementsAre(-7, 2, -2));
}

TEST(Natives, StatOfNothingWritesNothing) {
    Call call("math.stat");
    EXPECT_EQ(call.put(100, {1, 2, 3}).run({110, 100, 101, 102}, {0}), "");
    EXPECT_THAT(call.words(100, 3), ElementsAre(1, 2, 3));
}

TEST(Natives, SortSortsEveryLengthAndValue) {
    for (int size = 0; size <= 70; ++size) {
        Words words;
        for (int i = 0; i < size; ++i) words.push_back(static_cast<int16_t>(i * 25173 + 13849));
        Call call("math.sort");
        call.put(kBase, words).run({kBase}, {size});
        std::sort(words.begin(), words.end());
        ASSERT_EQ(call.words(kBase, size), words) << size;
    }
}

TEST(Natives, RotationTurnsWithTheErrorsOfTheTable) {
    Call call("math.rot2");
    EXPECT_EQ(call.put(100, {1000, 500, 0}).run({100, 100, 102}), "");  // in place
    EXPECT_THAT(call.words(100, 2), ElementsAre(999, 499));
    Call overflow("math.rot2");
    overflow.put(100, {32767, 32767, 8192}).run({110, 100, 102});
    EXPECT_THAT(overflow.words(110, 2), ElementsAre(0, -19196));
}

TEST(Natives, SquareRootIsTheFloorForEveryInput) {
    for (int value = 0; value <= 32767; ++value) {
        const int root = whole_sqrt(static_cast<int16_t>(value));
        ASSERT_LE(root * root, value);
        ASSERT_GT((root + 1) * (root + 1), value);
    }
}

TEST(Natives, SquareRootOfANegativeNumberIsAFaultBehindTheElementsBefore) {
    Call call("math.sqrt");
    const std::string fault = call.put(110, {49, -1, 4}).run({100, 110}, {3});
    EXPECT_NE(fault.find("4e 65 67 61 74 69 76 65"), std::string::npos);  // "Negative …"
    EXPECT_THAT(call.words(100, 3), ElementsAre(7, 0, 0));
    EXPECT_EQ(call.left_on_stack, 0);
}

// ---- Deques. Array of K + 2 words at 100; blocks at 200; index at 300, length at 301 ----

class Queue {
public:
    explicit Queue(int cells) : cells_(cells) {}

    std::string push_back(const Words& block) { return push("deque.push_back", block); }
    std::string push_front(const Words& block) { return push("deque.push_front", block); }
    std::string insert(int index, const Words& block) {
        return indexed("deque.insert", index, block);
    }
    std::string set(int index, const Words& block) { return indexed("deque.set", index, block); }
    std::string erase(int index, int count) {
        return call("deque.erase", {100, 300, 301}, {cells_ + 2},
                    {{300, {static_cast<int16_t>(index), static_cast<int16_t>(count)}}});
    }
    Words pop_front(int count) { return pop("deque.pop_front", count); }
    Words pop_back(int count) { return pop("deque.pop_back", count); }
    Words get(int index, int count) {
        fault = call(
            "deque.get", {100, 200, 300}, {cells_ + 2, count},
            {{200, Words(static_cast<size_t>(count), -99)}, {300, {static_cast<int16_t>(index)}}});
        return {memory_.begin() + 200, memory_.begin() + 200 + count};
    }
    int size() {
        fault = call("deque.size", {100, 300}, {cells_ + 2}, {});
        return memory_[300];
    }
    Words raw() const { return {memory_.begin() + 100, memory_.begin() + 102}; }
    Words all() { return get(0, size()); }
    Words at(uint16_t address, int count) const {
        return {memory_.begin() + address, memory_.begin() + address + count};
    }
    void put(uint16_t address, const Words& words) {
        std::copy(words.begin(), words.end(), memory_.begin() + address);
    }
    std::string fault;

private:
    using Inputs = std::vector<std::pair<uint16_t, Words>>;

    // Every call is a program of its own; what they share is the memory.
    std::string call(const std::string& name, const std::vector<int>& addresses,
                     const std::vector<int>& sizes, const Inputs& inputs) {
        for (const auto& [address, words] : inputs) put(address, words);
        Call made(name);
        made.put(0, memory_);
        const std::string result = made.run(addresses, sizes);
        EXPECT_EQ(made.left_on_stack, 0) << name;
        memory_ = made.words(0, static_cast<int>(memory_.size()));
        return result;
    }
    std::string push(const std::string& name, const Words& block) {
        return call(name, {100, 200}, {cells_ + 2, static_cast<int>(block.size())}, {{200, block}});
    }
    std::string indexed(const std::string& name, int index, const Words& block) {
        return call(name, {100, 200, 300}, {cells_ + 2, static_cast<int>(block.size())},
                    {{200, block}, {300, {static_cast<int16_t>(index)}}});
    }
    Words pop(const std::string& name, int count) {
        fault = call(name, {100, 200}, {cells_ + 2, count},
                     {{200, Words(static_cast<size_t>(count), -99)}});
        return {memory_.begin() + 200, memory_.begin() + 200 + count};
    }

    int cells_;
    Words memory_ = Words(1060);
};

TEST(Deques, PushAndPopAtBothEndsAsMeasured) {
    Queue q(8);
    q.push_back({1, 2, 3, 4});
    EXPECT_THAT(q.raw(), ElementsAre(4, 0));
    q.push_front({99, 98});
    EXPECT_THAT(q.raw(), ElementsAre(6, 6));
    EXPECT_THAT(q.pop_front(3), ElementsAre(99, 98, 1));
    EXPECT_THAT(q.raw(), ElementsAre(3, 1));
    EXPECT_THAT(q.pop_back(2), ElementsAre(3, 4));
    EXPECT_THAT(q.raw(), ElementsAre(1, 1));
}

TEST(Deques, InsertInTheFrontHalfMovesTheElementsBefore) {  // D5
    Queue q(8);
    q.push_back({1, 2, 3, 4});
    EXPECT_EQ(q.insert(1, {99}), "");
    EXPECT_THAT(q.all(), ElementsAre(1, 99, 2, 3, 4));
}

// Compared with std::vector, at every index, with every position of the front.
TEST(Deques, InsertAndEraseAgreeWithAVectorEverywhere) {
    constexpr int kCells = 7;
    for (int front = 0; front < kCells; ++front) {
        for (int count = 0; count <= kCells; ++count) {
            Words model;
            for (int i = 0; i < count; ++i) model.push_back(static_cast<int16_t>(10 + i));
            for (int index = 0; index <= count && index < kCells; ++index) {
                for (int size = 1; size <= kCells - count; ++size) {
                    Queue q(kCells);
                    q.put(101, {static_cast<int16_t>(front)});
                    q.push_back(model);
                    const Words block(static_cast<size_t>(size), -5);
                    ASSERT_EQ(q.insert(index, block), "");
                    Words expected = model;
                    expected.insert(expected.begin() + index, block.begin(), block.end());
                    ASSERT_EQ(q.all(), expected) << front << ' ' << count << ' ' << index;
                }
                for (int size = 1; size <= count - index; ++size) {
                    Queue q(kCells);
                    q.put(101, {static_cast<int16_t>(front)});
                    q.push_back(model);
                    ASSERT_EQ(q.erase(index, size), "");
                    Words expected = model;
                    expected.erase(expected.begin() + index, expected.begin() + index + size);
                    ASSERT_EQ(q.size(), static_cast<int>(expected.size()));
                    if (!expected.empty()) {
                        ASSERT_EQ(q.all(), expected) << front << ' ' << count << ' ' << index;
                    }
                }
            }
        }
    }
}

TEST(Deques, InsertBehindTheEndLeavesAHole) {  // D6
    Queue q(8);
    q.put(102, {1, 2, 3, 4, 5, 6, 7, 8});
    q.put(100, {2});
    EXPECT_EQ(q.insert(4, {99}), "");
    EXPECT_EQ(q.size(), 3);
    EXPECT_THAT(q.get(0, 3), ElementsAre(1, 2, 3));
    q.put(100, {5});
    EXPECT_THAT(q.all(), ElementsAre(1, 2, 3, 4, 99));
}

TEST(Deques, GetAndSetReachAcrossTheEndOfTheRing) {
    Queue q(4);
    q.put(101, {3});
    q.push_back({1, 2, 3});
    EXPECT_EQ(q.set(1, {8, 9}), "");
    EXPECT_THAT(q.all(), ElementsAre(1, 8, 9));
}

// One message of six bytes (D3, D4): pc, number of cells, index.
TEST(Deques, FaultsAreReportedOnceAndChangeNothing) {
    Queue q(4);
    q.push_back({1, 2, 3});
    EXPECT_THAT(q.pop_front(4), ElementsAre(-99, -99, -99, -99));
    EXPECT_EQ(q.fault, "06 00 01 00 06 90 0b 00 04 00 00 00");
    q.pop_back(4);
    EXPECT_EQ(q.fault, "06 00 01 00 06 90 0b 00 04 00 ff ff");
    EXPECT_EQ(q.push_back({8, 9}), "06 00 01 00 06 90 0b 00 04 00 03 00");
    EXPECT_EQ(q.insert(4, {8}), "06 00 01 00 06 90 0d 00 04 00 04 00");
    EXPECT_EQ(q.insert(-1, {8}), "06 00 01 00 06 90 0d 00 04 00 ff ff");
    EXPECT_EQ(q.erase(2, 2), "06 00 01 00 06 90 0b 00 04 00 02 00");
    EXPECT_EQ(q.set(2, {8, 9}), "06 00 01 00 06 90 0d 00 04 00 02 00");
    EXPECT_THAT(q.all(), ElementsAre(1, 2, 3));
}

TEST(Deques, AnArrayWithoutCellsHoldsNothing) {
    for (int cells : {-1, 0}) {
        Queue q(cells);
        q.put(100, {5});
        EXPECT_EQ(q.push_back({8}), "06 00 01 00 06 90 0b 00 00 00 00 00");
        EXPECT_EQ(q.size(), 5);
    }
}

// Whatever a script writes into the header, nothing outside the array changes.
TEST(Deques, NonsenseInTheHeaderStaysInside) {
    const std::vector<int16_t> nonsense = {-1, -32768, 32767, 5, 4, 255};
    for (int16_t count : nonsense) {
        for (int16_t front : nonsense) {
            Queue q(4);
            q.put(106, {77, 77});
            q.put(98, {77, 77});
            q.put(100, {count, front});
            q.insert(1, {1, 2});
            q.push_front({3});
            q.push_back({4});
            q.erase(0, 30000);
            q.erase(3, 1);
            q.set(2, {5});
            q.pop_front(2);
            q.pop_back(1);
            q.get(0, 100);
            Words around = q.at(98, 2);
            EXPECT_THAT(around, ElementsAre(77, 77));
            around = q.at(106, 2);
            EXPECT_THAT(around, ElementsAre(77, 77));
        }
    }
}

// ---- Every native: addresses, stack ----

// Number of arguments and of templates of native `id`.
std::pair<int, int> shape(uint16_t id) {
    const Native& native = kStandardNatives[id];
    int templates = 0;
    for (uint16_t i = 0; i < native.parameter_count; ++i) {
        templates = std::max(templates, -static_cast<int>(native.parameters[i].size));
    }
    return {native.parameter_count, templates};
}

TEST(Natives, AddressBeyondTheVariablesIsAFaultThatTouchesNothing) {
    for (uint16_t id = 0; id < kStandardNativeCount; ++id) {
        const auto [arguments, templates] = shape(id);
        for (int wrong = 0; wrong < arguments; ++wrong) {
            std::vector<int> addresses(static_cast<size_t>(arguments), 100);
            addresses[static_cast<size_t>(wrong)] = 1060;
            Call call(kStandardNatives[id].name);
            const std::string fault =
                call.run(addresses, std::vector<int>(static_cast<size_t>(templates), 4));
            EXPECT_EQ(fault.substr(6, 11), "01 00 09 90") << kStandardNatives[id].name;
            EXPECT_EQ(call.left_on_stack, 0) << kStandardNatives[id].name;
            EXPECT_EQ(call.words(0, 1060), Words(1060)) << kStandardNatives[id].name;
        }
    }
}

TEST(Natives, LengthBeyondTheVariablesIsAFault) {
    for (uint16_t id = 0; id < kStandardNativeCount; ++id) {
        const auto [arguments, templates] = shape(id);
        if (templates == 0) continue;
        for (int size : {961, 32767, -1}) {  // 100 + 960 would just fit
            Call call(kStandardNatives[id].name);
            const std::string fault =
                call.run(std::vector<int>(static_cast<size_t>(arguments), 100),
                         std::vector<int>(static_cast<size_t>(templates), size));
            EXPECT_EQ(fault.substr(6, 11), "01 00 09 90") << kStandardNatives[id].name << size;
            EXPECT_EQ(call.left_on_stack, 0) << kStandardNatives[id].name;
        }
    }
}

TEST(Natives, EmptyStackIsAFault) {
    for (uint16_t id = 0; id < kStandardNativeCount; ++id) {
        Call call(kStandardNatives[id].name);
        const std::string fault = call.run({});
        EXPECT_EQ(fault.substr(6, 11), "01 00 09 90") << kStandardNatives[id].name;
        EXPECT_EQ(fault.find('\n'), std::string::npos) << "one fault, one message: " << fault;
    }
}

}  // namespace
}  // namespace vagus::node
