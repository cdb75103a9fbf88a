#include "fleet/topic.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "fleet/limits.hpp"

namespace vagus::fleet {
namespace {

constexpr std::string_view kRoot = "vagus/1/";
constexpr std::string_view kAll = "all";
constexpr std::string_view kGroup = "group";

bool stands_as_it_is(char byte) {
    return (byte >= 'A' && byte <= 'Z') || (byte >= 'a' && byte <= 'z') ||
           (byte >= '0' && byte <= '9') || byte == '_' || byte == '.' || byte == '-';
}

std::optional<int> hex_digit(char byte) {
    if (byte >= '0' && byte <= '9') return byte - '0';
    if (byte >= 'A' && byte <= 'F') return byte - 'A' + 10;
    return std::nullopt;
}

std::string prefix(std::string_view fleet) {
    return fmt::format("{}{}/", kRoot, escape(fleet));
}

// The levels behind vagus/1/FLEET/, unescaped; empty if one is no name.
std::vector<std::string> levels_of(std::string_view fleet, std::string_view text) {
    const std::string front = prefix(fleet);
    std::vector<std::string> levels;
    if (text.size() > kTopicBytesMax || !text.starts_with(front)) return levels;
    text.remove_prefix(front.size());
    for (const std::string_view level : split(text, '/')) {
        auto name = unescape(level);
        if (!name) return {};
        levels.push_back(std::move(*name));
    }
    return levels;
}

std::optional<Topic> topic_of_robot(const std::vector<std::string>& levels) {
    const std::string& robot = levels[1];
    if (!is_robot_name(robot)) return std::nullopt;
    const std::string& word = levels[2];
    for (const KindInfo& info : kinds()) {
        if (info.folder != Folder::Robot || info.word != word) continue;
        if (levels.size() != 3 + info.names) continue;
        // Both are asked at one place; the keeper's have names of their own.
        if (info.kind == Kind::Ask && question_of(levels.back())) continue;
        if (info.kind == Kind::Question && !question_of(levels.back())) continue;
        Topic topic{.kind = info.kind, .robot = robot};
        if (info.names > 0) topic.name = levels.back();
        if (info.names > 1) topic.node = levels[3];
        return topic;
    }
    return std::nullopt;
}

// keeper/beat, keeper/answer/R
std::optional<Topic> topic_of_keeper(const std::vector<std::string>& levels) {
    if (levels.size() == 2 && levels[1] == "beat") return Topic{.kind = Kind::Beat};
    if (levels.size() != 3 || levels[1] != "answer") return std::nullopt;
    if (!is_robot_name(levels[2])) return std::nullopt;
    return Topic{.kind = Kind::Reply, .robot = levels[2]};
}

// cmd/R/VERB, cmd/all/VERB, cmd/group/G/VERB
std::optional<Topic> topic_of_command(const std::vector<std::string>& levels) {
    Topic topic{.kind = Kind::Command, .name = levels.back()};
    if (levels[1] == kGroup) {
        if (levels.size() != 4) return std::nullopt;
        topic.group = levels[2];
        return topic;
    }
    if (levels.size() != 3) return std::nullopt;
    if (levels[1] != kAll) topic.robot = levels[1];
    return topic;
}

}  // namespace

bool is_name(std::string_view text) {
    if (text.empty() || text.size() > kNameBytesMax || malformed_utf8_at(text)) return false;
    return std::none_of(text.begin(), text.end(), [](char byte) {
        const auto value = static_cast<unsigned char>(byte);
        return value < 0x20 || value == 0x7f;
    });
}

bool is_robot_name(std::string_view text) {
    return is_name(text) && text != kAll && text != kGroup;
}

std::string escape(std::string_view name) {
    std::string level;
    for (const char byte : name) {
        if (stands_as_it_is(byte)) {
            level += byte;
        } else {
            level += fmt::format("%{:02X}", static_cast<unsigned char>(byte));
        }
    }
    return level;
}

std::optional<std::string> unescape(std::string_view level) {
    std::string name;
    for (size_t i = 0; i < level.size(); ++i) {
        if (level[i] != '%') {
            name += level[i];
            continue;
        }
        if (i + 2 >= level.size()) return std::nullopt;
        const auto high = hex_digit(level[i + 1]), low = hex_digit(level[i + 2]);
        if (!high || !low) return std::nullopt;
        name += static_cast<char>(*high * 16 + *low);
        i += 2;
    }
    // One name has one topic.
    if (!is_name(name) || escape(name) != level) return std::nullopt;
    return name;
}

std::optional<Topic> parse_topic(std::string_view fleet, std::string_view text) {
    const std::vector<std::string> levels = levels_of(fleet, text);
    if (levels.size() < 2) return std::nullopt;
    const std::string& folder = levels[0];
    if (folder == "robot" && levels.size() > 2) return topic_of_robot(levels);
    if (folder == "cmd" && levels.size() > 2) return topic_of_command(levels);
    if (folder == "shared" && levels.size() == 2)
        return Topic{.kind = Kind::Shared, .name = levels[1]};
    if (folder == "task" && levels.size() == 3) {
        return Topic{.kind = Kind::Task, .name = levels[2], .queue = levels[1]};
    }
    return folder == "keeper" ? topic_of_keeper(levels) : std::nullopt;
}

std::string text_of(std::string_view fleet, const Topic& topic) {
    const KindInfo& info = info_of(topic.kind);
    std::string text = prefix(fleet);
    if (info.folder == Folder::Command) {
        if (!topic.robot.empty()) {
            text += "cmd/" + escape(topic.robot);
        } else {
            text += topic.group.empty() ? "cmd/all" : "cmd/group/" + escape(topic.group);
        }
        return text + "/" + escape(topic.name);
    }
    if (topic.kind == Kind::Shared) return text + "shared/" + escape(topic.name);
    if (topic.kind == Kind::Task) {
        return text + fmt::format("task/{}/{}", escape(topic.queue), escape(topic.name));
    }
    if (topic.kind == Kind::Beat) return text + "keeper/beat";
    if (topic.kind == Kind::Reply) return text + "keeper/answer/" + escape(topic.robot);
    text += fmt::format("robot/{}/{}", escape(topic.robot), info.word);
    if (info.names > 1) text += "/" + escape(topic.node);
    if (info.names > 0) text += "/" + escape(topic.name);
    return text;
}

std::string filter_of(std::string_view fleet, Kind kind) {
    const KindInfo& info = info_of(kind);
    if (info.folder == Folder::Shared) return prefix(fleet) + "shared/+";
    if (info.folder == Folder::Task) return prefix(fleet) + "task/+/+";
    if (kind == Kind::Beat) return prefix(fleet) + "keeper/beat";
    if (kind == Kind::Reply) return prefix(fleet) + "keeper/answer/+";
    std::string text = fmt::format("{}robot/+/{}", prefix(fleet), info.word);
    for (size_t i = 0; i < info.names; ++i) text += "/+";
    return text;
}

std::string filter_of_event(std::string_view fleet, std::string_view event) {
    return fmt::format("{}robot/+/event/{}", prefix(fleet), escape(event));
}

std::string filter_of_commands(std::string_view fleet, std::string_view robot) {
    return fmt::format("{}cmd/{}/+", prefix(fleet), escape(robot));
}

bool matches_filter(std::string_view filter, std::string_view topic) {
    for (;;) {
        const size_t wanted = std::min(filter.find('/'), filter.size());
        const size_t level = std::min(topic.find('/'), topic.size());
        const bool any = filter.substr(0, wanted) == "+";
        if (!any && filter.substr(0, wanted) != topic.substr(0, level)) return false;
        const bool more = wanted < filter.size();
        if (more != (level < topic.size())) return false;
        if (!more) return true;
        filter.remove_prefix(wanted + 1);
        topic.remove_prefix(level + 1);
    }
}

}  // namespace vagus::fleet
