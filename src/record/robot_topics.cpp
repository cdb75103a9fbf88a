#include "record/robot_topics.hpp"

#include "record/topics.hpp"

namespace vagus::record {

std::string robot_of(std::string_view topic, const RobotNames& robots) {
    std::string longest;
    if (robots.empty() || !topic.starts_with(kRobotTopics)) return longest;
    const std::string_view rest = topic.substr(kRobotTopics.size());
    for (size_t end = rest.find('/'); end != std::string_view::npos;
         end = rest.find('/', end + 1)) {
        const auto found = robots.find(rest.substr(0, end));
        if (found != robots.end()) longest = *found;
    }
    return longest;
}

std::string_view below_robot(std::string_view topic, std::string_view robot) {
    return robot.empty() ? topic : topic.substr(kRobotTopics.size() + robot.size());
}

}  // namespace vagus::record
