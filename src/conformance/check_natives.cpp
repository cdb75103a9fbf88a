// The standard natives, called as section 4.1 says, with the values of 4.2 to 4.5 and appendix C.

#include <algorithm>

#include "conformance/checks.hpp"
#include "conformance/native_call.hpp"

namespace vagus::conformance {
namespace {

using wire::MessageType;

// The words of each argument, in the order of the parameters, before the call and after it.
struct Case {
    std::vector<Values> before;
    std::vector<Values> after;
};

struct NativeRow {
    const char* check;
    const char* native;
    const char* section;
    const char* defects;
    std::vector<Case> cases;
};

using Rows = std::vector<NativeRow>;

Rows copying_rows() {
    return {
        {"math.copy",
         "math.copy",
         "4.2",
         "",
         {{{{0, 0, 9}, {1, -2, 3}}, {{1, -2, 3}, {1, -2, 3}}}}},
        {"math.fill", "math.fill", "4.2", "", {{{{0, 0, 0}, {7}}, {{7, 7, 7}, {7}}}}},
        {"math.addscalar",
         "math.addscalar",
         "4.2",
         "",
         {{{{0, 0}, {1, 32767}, {3}}, {{4, -32766}, {1, 32767}, {3}}}}},
        {"math.add",
         "math.add",
         "4.2",
         "",
         {{{{0, 0}, {1, 32767}, {2, 1}}, {{3, -32768}, {1, 32767}, {2, 1}}}}},
        {"math.sub",
         "math.sub",
         "4.2",
         "",
         {{{{0, 0}, {1, -32768}, {5, 1}}, {{-4, 32767}, {1, -32768}, {5, 1}}}}},
        {"math.mul",
         "math.mul",
         "4.2",
         "",
         {{{{0, 0}, {-3, 300}, {7, 300}}, {{-21, 24464}, {-3, 300}, {7, 300}}}}},
    };
}

Rows comparing_rows() {
    return {
        {"math.div",
         "math.div",
         "4.2",
         "",
         {{{{0, 0, 0}, {-7, -32768, 7}, {2, -1, -2}},
           {{-3, -32768, -3}, {-7, -32768, 7}, {2, -1, -2}}}}},
        {"math.min",
         "math.min",
         "4.2",
         "",
         {{{{0, 0}, {1, -5}, {2, -6}}, {{1, -6}, {1, -5}, {2, -6}}}}},
        {"math.max",
         "math.max",
         "4.2",
         "",
         {{{{0, 0}, {1, -5}, {2, -6}}, {{2, -5}, {1, -5}, {2, -6}}}}},
        {"math.clamp",
         "math.clamp",
         "4.2, C",
         "",
         {{{{0, 0, 0}, {5, -1, 2}, {0, 0, 0}, {3, 3, 3}},
           {{3, 0, 2}, {5, -1, 2}, {0, 0, 0}, {3, 3, 3}}},
          {{{9, 9}, {5, -5}, {10, 10}, {0, 0}}, {{0, 10}, {5, -5}, {10, 10}, {0, 0}}}}},
        {"math.sort",
         "math.sort",
         "4.2",
         "",
         {{{{3, -1, 2, -32768, 32767, 0, 2}}, {{-32768, -1, 0, 2, 2, 3, 32767}}}}},
        {"math.muldiv",
         "math.muldiv",
         "4.2, C",
         "",
         {{{{9, 9, 9, 9}, {-32768, 32767, -1000, 7}, {-32768, 32767, 1000, -1}, {-1, 1, 3, 2}},
           {{0, 1, -5653, -3},
            {-32768, 32767, -1000, 7},
            {-32768, 32767, 1000, -1},
            {-1, 1, 3, 2}}}}},
        {"math.sqrt",
         "math.sqrt",
         "4.2",
         "",
         {{{{9, 9, 9, 9, 9, 9}, {0, 1, 3, 4, 100, 32767}},
           {{0, 1, 1, 2, 10, 181}, {0, 1, 3, 4, 100, 32767}}}}},
    };
}

// The scalar product of [1000, -2000, 3000] and [20000, 4, 30000], shifted.
Case dot_case(int16_t shift, int16_t result) {
    const Values left{1000, -2000, 3000}, right{20000, 4, 30000};
    return {{{1}, left, right, {shift}}, {{result}, left, right, {shift}}};
}

Rows statistic_rows() {
    const Values most(3, 32767);
    return {
        {"math.dot",
         "math.dot",
         "4.2, C",
         "",
         {dot_case(0, 22592),
          dot_case(2, -27120),
          dot_case(14, 6713),
          dot_case(27, 0),
          dot_case(32, 22592),
          dot_case(33, 0),
          dot_case(-1, 0),
          {{{0}, most, most, {15}}, {{32762}, most, most, {15}}}}},
        {"math.stat",
         "math.stat",
         "4.2",
         "",
         {{{{-7, 2, -2}, {9}, {9}, {9}}, {{-7, 2, -2}, {-7}, {2}, {-2}}},
          {{{5}, {9}, {9}, {9}}, {{5}, {5}, {5}, {5}}}}},
        {"math.argbounds",
         "math.argbounds",
         "4.2, C",
         "",
         {{{{5, 1, 5, 1}, {9}, {9}}, {{5, 1, 5, 1}, {1}, {0}}},
          {{{32767, 32767}, {9}, {9}}, {{32767, 32767}, {9}, {0}}},
          {{{-32768, -32768}, {9}, {9}}, {{-32768, -32768}, {0}, {9}}}}},
    };
}

Rows angle_rows() {
    const Values sines{0, 1, 64, 8192, 16384, -16384, 32767, -32768};
    const Values cosines{0, 8192, 16384, -32768};
    const Values y{0, 0, 1, -1, 1, 1, -1}, more_y{-1, 1, 100, 3, -32768, -32768, 5};
    const Values x{0, -5, 0, 0, 1, -1, -1}, more_x{1, 32767, 3, 100, 1, -32768, -32768};
    const Values angles{0, -32768, 16384, -16384, 8203, 24565, -24565};
    const Values more_angles{-8203, 0, 16071, 312, -16384, -24565, 16384};
    return {
        {"math.sin",
         "math.sin",
         "4.3, C",
         "",
         {{{Values(8, 9), sines}, {{0, 3, 201, 23171, 32767, -32767, 3, 0}, sines}}}},
        {"math.cos",
         "math.cos",
         "4.3, C",
         "",
         {{{Values(4, 9), cosines}, {{32767, 23171, 0, -32767}, cosines}}}},
        {"math.atan2",
         "math.atan2",
         "4.3, C",
         "",
         {{{Values(7, 9), y, x}, {angles, y, x}},
          {{Values(7, 9), more_y, more_x}, {more_angles, more_y, more_x}}}},
        {"math.rot2",
         "math.rot2",
         "4.3",
         "",
         {{{{9, 9}, {1000, 500}, {0}}, {{999, 499}, {1000, 500}, {0}}},
          {{{9, 9}, {32767, 32767}, {8192}}, {{0, -19196}, {32767, 32767}, {8192}}}}},
    };
}

// Count, front, 8 cells: section 4.5. The values follow from its rules, cell by cell.
Rows deque_rows() {
    const Values four{4, 6, 3, 4, 0, 0, 0, 0, 1, 2};  // 1, 2, 3, 4 from cell 6 on
    const Values straight{4, 0, 1, 2, 3, 4, 0, 0, 0, 0};
    return {
        {"deque.size", "deque.size", "4.5", "", {{{four, {9}}, {four, {4}}}}},
        {"deque.get", "deque.get", "4.5", "", {{{four, {9, 9}, {1}}, {four, {2, 3}, {1}}}}},
        {"deque.set",
         "deque.set",
         "4.5",
         "",
         {{{four, {8, 9}, {2}}, {{4, 6, 8, 9, 0, 0, 0, 0, 1, 2}, {8, 9}, {2}}}}},
        {"deque.insert in the front half",
         "deque.insert",
         "4.5, 8 D5",
         "D5",
         {{{straight, {99}, {1}}, {{5, 7, 99, 2, 3, 4, 0, 0, 0, 1}, {99}, {1}}}}},
        {"deque.insert in the back half",
         "deque.insert",
         "4.5",
         "",
         {{{straight, {99}, {3}}, {{5, 0, 1, 2, 3, 99, 4, 0, 0, 0}, {99}, {3}}}}},
        {"deque.insert behind the end leaves a hole",
         "deque.insert",
         "4.5, 8 D6",
         "",
         {{{{2, 0, 1, 2, 0, 0, 0, 0, 0, 0}, {9}, {5}},
           {{3, 0, 1, 2, 0, 0, 0, 9, 0, 0}, {9}, {5}}}}},
    };
}

Rows deque_end_rows() {
    const Values straight{4, 0, 1, 2, 3, 4, 0, 0, 0, 0};
    const Values six{6, 0, 1, 2, 3, 4, 5, 6, 0, 0};
    return {
        {"deque.erase in the front half",
         "deque.erase",
         "4.5",
         "",
         {{{six, {1}, {1}}, {{5, 1, 1, 1, 3, 4, 5, 6, 0, 0}, {1}, {1}}}}},
        {"deque.erase in the back half",
         "deque.erase",
         "4.5",
         "",
         {{{six, {4}, {1}}, {{5, 0, 1, 2, 3, 4, 6, 6, 0, 0}, {4}, {1}}}}},
        {"deque.push_back",
         "deque.push_back",
         "4.5, C",
         "",
         {{{Values(10, 0), {1, 2, 3, 4}}, {straight, {1, 2, 3, 4}}},
          {{straight, {5}}, {{5, 0, 1, 2, 3, 4, 5, 0, 0, 0}, {5}}}}},
        {"deque.push_front",
         "deque.push_front",
         "4.5, C",
         "",
         {{{straight, {99, 98}}, {{6, 6, 1, 2, 3, 4, 0, 0, 99, 98}, {99, 98}}}}},
        {"deque.pop_front",
         "deque.pop_front",
         "4.5, C",
         "",
         {{{{6, 6, 1, 2, 3, 4, 0, 0, 99, 98}, {9, 9, 9}},
           {{3, 1, 1, 2, 3, 4, 0, 0, 99, 98}, {99, 98, 1}}}}},
        {"deque.pop_back",
         "deque.pop_back",
         "4.5, C",
         "",
         {{{{3, 1, 1, 2, 3, 4, 0, 0, 99, 98}, {9, 9}},
           {{1, 1, 1, 2, 3, 4, 0, 0, 99, 98}, {3, 4}}}}},
    };
}

// Filled to the last cell, from each side, and emptied from there.
Rows deque_full_rows() {
    const Values seven{7, 0, 1, 2, 3, 4, 5, 6, 7, 0};
    const Values full{8, 0, 1, 2, 3, 4, 5, 6, 7, 8};
    return {
        {"deque.push_back fills the last cell",
         "deque.push_back",
         "4.5",
         "",
         {{{seven, {8}}, {full, {8}}}, {{{0, 0, 0}, {9}}, {{1, 0, 9}, {9}}}}},
        {"deque.push_front fills the last cell",
         "deque.push_front",
         "4.5",
         "",
         {{{seven, {8}}, {{8, 7, 1, 2, 3, 4, 5, 6, 7, 8}, {8}}}}},
        {"deque.insert fills the last cell",
         "deque.insert",
         "4.5",
         "",
         {{{seven, {8}, {7}}, {full, {8}, {7}}}}},
        {"deque.get reads the last cell",
         "deque.get",
         "4.5",
         "",
         {{{full, {9, 9}, {6}}, {full, {7, 8}, {6}}}}},
        {"deque.set writes the last cell",
         "deque.set",
         "4.5",
         "",
         {{{full, {-8}, {7}}, {{8, 0, 1, 2, 3, 4, 5, 6, 7, -8}, {-8}, {7}}}}},
        {"deque.pop_back empties a full one",
         "deque.pop_back",
         "4.5",
         "",
         {{{full, Values(8, 9)}, {{0, 0, 1, 2, 3, 4, 5, 6, 7, 8}, {1, 2, 3, 4, 5, 6, 7, 8}}}}},
        {"deque.pop_front empties a full one",
         "deque.pop_front",
         "4.5",
         "",
         {{{full, Values(8, 9)}, {{0, 0, 1, 2, 3, 4, 5, 6, 7, 8}, {1, 2, 3, 4, 5, 6, 7, 8}}}}},
    };
}

Status gives(Bench& bench, const NativeRow& row, const Case& one) {
    const Values before = flat(one.before);
    const uint16_t at = TRY(bench.room(static_cast<uint16_t>(before.size())));
    const Instructions call = TRY(native_call(bench, row.native, one.before, at));
    TRY(bench.set(at, before));
    TRY(bench.run_to_end(program_of(Instructions().words(call.all()).stop())));
    const Values found = TRY(bench.get(at, static_cast<uint16_t>(before.size())));
    if (found == flat(one.after)) return Status::done();
    return finding(std::string(row.native) + " of " + text_of(before) + ": expected " +
                   text_of(flat(one.after)) + ", found " + text_of(found));
}

Status gives_all(Bench& bench, const NativeRow& row) {
    for (const Case& one : row.cases) TRY(gives(bench, row, one));
    return Status::done();
}

// Falling, and as a small generator mixes it, with numbers that come twice.
Values mixed_values(size_t length) {
    Values values;
    uint32_t word = 7 + static_cast<uint32_t>(length);
    for (size_t i = 0; i < length; i++) {
        word = 25173u * word + 13849u;
        values.push_back(static_cast<int16_t>((word >> 8) % 23) - 11);
    }
    return values;
}

Values falling_values(size_t length) {
    Values values;
    for (size_t i = 0; i < length; i++) values.push_back(static_cast<int16_t>(length - i));
    return values;
}

// The word behind them stays.
Status sorts(Bench& bench, uint16_t native, const Values& values) {
    constexpr int16_t kBehind = -300;  // smaller than all: it would come to the front
    const auto length = static_cast<uint16_t>(values.size());
    const uint16_t at = TRY(bench.room(length + 1));
    Values before = values, after = values;
    before.push_back(kBehind);
    std::ranges::sort(after);
    after.push_back(kBehind);
    TRY(bench.set(at, before));
    TRY(bench.run_to_end(program_of(Instructions().push(length).push(at).native(native).stop())));
    const Values found = TRY(bench.get(at, length + 1));
    if (found == after) return Status::done();
    return finding("math.sort of " + std::to_string(length) + " words, " + text_of(before) +
                   ": expected " + text_of(after) + ", found " + text_of(found));
}

// A sort that is made for some lengths is wrong at others: all up to the first power of two that
// needs a sixth level of a heap.
Status sorts_each_length(Bench& bench) {
    constexpr uint16_t kLongest = 33;
    const uint16_t id = TRY(bench.native("math.sort"));
    const auto longest = std::min<uint16_t>(kLongest, static_cast<uint16_t>(bench.room_size() - 1));
    (void)TRY(bench.room(2));
    for (uint16_t length = 0; length <= longest; length++) {
        TRY(sorts(bench, id, falling_values(length)));
        TRY(sorts(bench, id, mixed_values(length)));
    }
    return Status::done();
}

// [1, 2, 3, 4, 5] copied one place up, element by element from the first, becomes 1, 1, 1, 1, 1.
Status copy_onto_itself(Bench& bench) {
    const uint16_t id = TRY(bench.native("math.copy"));
    const uint16_t at = TRY(bench.room(6));
    TRY(bench.set(at, {1, 2, 3, 4, 5, 0}));
    const Instructions code = Instructions().push(5).push(at).push(at + 1).native(id).stop();
    TRY(bench.run_to_end(program_of(code)));
    return bench.expect_values(at, {1, 1, 1, 1, 1, 1});
}

// The number to be added is the first word that is written: it is read once, before.
Status addscalar_onto_its_number(Bench& bench) {
    const uint16_t id = TRY(bench.native("math.addscalar"));
    const uint16_t at = TRY(bench.room(3));
    TRY(bench.set(at, {1, 2, 3}));
    const Instructions code = Instructions().push(3).push(at).push(at).push(at).native(id).stop();
    TRY(bench.run_to_end(program_of(code)));
    return bench.expect_values(at, {2, 3, 4});
}

// Each word follows from the one before: 25173 times it, and 13849.
Status random_words(Bench& bench) {
    const uint16_t id = TRY(bench.native("math.rand"));
    const uint16_t at = TRY(bench.room(4));
    const Instructions code = Instructions().push(4).push(at).native(id).stop();
    TRY(bench.run_to_end(program_of(code)));
    const Values found = TRY(bench.get(at, 4));
    for (size_t i = 1; i < found.size(); i++) {
        const uint32_t last = static_cast<uint16_t>(found[i - 1]);
        const uint16_t next = static_cast<uint16_t>(25173u * last + 13849u);
        if (static_cast<uint16_t>(found[i]) != next)
            return finding("after " + std::to_string(found[i - 1]) + " expected " +
                           std::to_string(static_cast<int16_t>(next)) + ", found " +
                           text_of(found));
    }
    return Status::done();
}

// Every native takes its arguments off the stack: it is called more often than they fit.
Status arguments_are_popped(Bench& bench) {
    const uint16_t id = TRY(bench.native("math.fill"));
    const uint16_t at = TRY(bench.room(2));
    const uint16_t stack = bench.target().stack_size;
    TRY(bench.set(at, {0, 3}));
    Instructions code;
    code.push(stack).store(at + 1);
    code.push(1).push(at + 1).push(at).native(id);  // 3 words
    code.load(at + 1).push(1).binary(isa::BinaryOperator::Subtract).store(at + 1);
    code.load(at + 1).push(0).branch(isa::BinaryOperator::Bigger, 3).jump(-17).stop();
    TRY(bench.run_to_end(program_of(code)));
    return bench.expect_values(at, {1, 0});
}

}  // namespace

void add_native_checks(Checks& checks) {
    for (const Rows& rows : {copying_rows(), comparing_rows(), statistic_rows(), angle_rows(),
                             deque_rows(), deque_end_rows(), deque_full_rows()}) {
        for (const NativeRow& row : rows) {
            checks.push_back({"natives", row.check, row.section, row.defects,
                              [row](Bench& bench) { return gives_all(bench, row); }});
        }
    }
    checks.push_back({"natives", "math.sort at each length", "4.2", "", sorts_each_length});
    checks.push_back({"natives", "math.copy onto itself", "4.2", "", copy_onto_itself});
    checks.push_back(
        {"natives", "math.addscalar onto its number", "4.2", "", addscalar_onto_its_number});
    checks.push_back({"natives", "math.rand", "4.4", "", random_words});
    checks.push_back({"natives", "natives pop their arguments", "4.1", "", arguments_are_popped});
}

}  // namespace vagus::conformance
