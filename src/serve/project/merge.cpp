#include "serve/project/merge.hpp"

#include <algorithm>

#include "serve/project/difference.hpp"
#include "serve/project/line_ends.hpp"

namespace vagus::serve {

namespace {

using Lines = std::vector<std::string_view>;

bool is_insertion(const LineDifference& one) {
    return one.from == one.to;
}

bool same_place(const LineDifference& one, const LineDifference& other) {
    if (is_insertion(one) && is_insertion(other)) return one.from == other.from;
    if (is_insertion(one)) return other.from < one.from && one.from < other.to;
    if (is_insertion(other)) return one.from < other.from && other.from < one.to;
    return std::max(one.from, other.from) < std::min(one.to, other.to);
}

// What both did alike is no conflict.
bool alike(const LineDifference& one, const Lines& its, const LineDifference& other,
           const Lines& others) {
    if (one.from != other.from || one.to != other.to) return false;
    return std::equal(its.begin() + static_cast<long>(one.at),
                      its.begin() + static_cast<long>(one.end),
                      others.begin() + static_cast<long>(other.at),
                      others.begin() + static_cast<long>(other.end));
}

enum class SamePlace { Refuse, KeepBoth };

class Merge {
public:
    Merge(std::string_view base, std::string_view mine, std::string_view theirs)
        : base_(lines_of(base)), mine_(lines_of(mine)), theirs_(lines_of(theirs)) {}

    std::optional<std::string> run(SamePlace in_same_place) {
        const auto my = line_differences(base_, mine_);
        const auto their = line_differences(base_, theirs_);
        size_t i = 0;
        size_t j = 0;
        while (i < my.size() || j < their.size()) {
            const bool both = i < my.size() && j < their.size();
            if (both && alike(my[i], mine_, their[j], theirs_)) {
                ++j;
                continue;
            }
            if (both && same_place(my[i], their[j])) {
                if (in_same_place == SamePlace::Refuse) return std::nullopt;
                take_both({my, i}, {their, j});
                continue;
            }
            const bool take_mine = j >= their.size() || (both && comes_first(my[i], their[j]));
            if (take_mine) {
                take(my[i++], mine_);
            } else {
                take(their[j++], theirs_);
            }
        }
        copy_base(base_.size());
        return std::move(result_);
    }

private:
    static bool comes_first(const LineDifference& one, const LineDifference& other) {
        return std::pair(one.from, one.to) < std::pair(other.from, other.to);
    }
    struct Side {
        const std::vector<LineDifference>& all;
        size_t& next;
    };
    // The lines of the base that the next differences of both touch, with those that lie in them:
    // first as one side has them, then as the other.
    void take_both(Side my, Side their) {
        const LineDifference& first = my.all[my.next];
        const LineDifference& other = their.all[their.next];
        const size_t from = std::min(first.from, other.from);
        size_t to = std::max(first.to, other.to);
        size_t my_end = my.next + 1;
        size_t their_end = their.next + 1;
        for (bool grows = true; grows;) {
            grows = grow(my.all, my_end, to);
            grows = grow(their.all, their_end, to) || grows;
        }
        copy_base(from);
        take_lines(my, my_end, to, mine_);
        at_ = from;
        take_lines(their, their_end, to, theirs_);
    }
    static bool grow(const std::vector<LineDifference>& all, size_t& end, size_t& to) {
        if (end >= all.size() || all[end].from >= to) return false;
        to = std::max(to, all[end++].to);
        return true;
    }
    void take_lines(Side side, size_t end, size_t to, const Lines& lines) {
        if (!result_.empty() && result_.back() != '\n') result_ += '\n';
        while (side.next < end) take(side.all[side.next++], lines);
        copy_base(to);
    }
    void copy_base(size_t to) {
        for (; at_ < to; ++at_) result_ += base_[at_];
    }
    void take(const LineDifference& one, const Lines& lines) {
        copy_base(one.from);
        for (size_t i = one.at; i < one.end; ++i) result_ += lines[i];
        at_ = one.to;
    }

    Lines base_, mine_, theirs_;
    std::string result_;
    size_t at_ = 0;  // line of the base that comes next
};

// "\n" or "\r\n", if every line ends with it; empty: not all, or there is only one line.
std::string_view end_of_all(std::string_view text) {
    const auto feeds = std::count(text.begin(), text.end(), '\n');
    const auto returns = std::count(text.begin(), text.end(), '\r');
    if (feeds == 0 || (returns != 0 && returns != feeds)) return "";
    size_t both = 0;
    for (size_t at = 0; (at = text.find("\r\n", at)) != std::string_view::npos; at += 2) ++both;
    if (both != static_cast<size_t>(returns)) return "";
    return returns == 0 ? "\n" : "\r\n";
}

std::string with_ends(std::string_view text, std::string_view end) {
    std::string result;
    for (const char each : with_line_feeds(text)) {
        each == '\n' ? result.append(end) : result.append(1, each);
    }
    return result;
}

// Who changed what all lines end with has changed none of them beside that: then the end of all
// lines is theirs, and the lines are compared without it.
struct Compared {
    Compared(std::string_view its_base, std::string_view its_mine, std::string_view theirs) {
        const std::string_view was = end_of_all(its_base), is = end_of_all(theirs);
        const bool other = !was.empty() && !is.empty() && was != is;
        base = other ? with_ends(its_base, is) : std::string(its_base);
        mine = other ? with_ends(its_mine, is) : std::string(its_mine);
    }
    std::string base, mine;
};

}  // namespace

std::optional<std::string> merged(std::string_view base, std::string_view mine,
                                  std::string_view theirs) {
    if (mine == base) return std::string(theirs);
    if (theirs == base || theirs == mine) return std::string(mine);
    const Compared compared(base, mine, theirs);
    return Merge(compared.base, compared.mine, theirs).run(SamePlace::Refuse);
}

std::string with_both(std::string_view base, std::string_view mine, std::string_view theirs) {
    const Compared compared(base, mine, theirs);
    return *Merge(compared.base, compared.mine, theirs).run(SamePlace::KeepBoth);
}

}  // namespace vagus::serve
