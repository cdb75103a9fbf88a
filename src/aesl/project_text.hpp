// Changes of an `.aesl` file in its text: only the bytes that are meant change, whatever wrote the
// rest, and however. For editors; the file must have been read by parse_project() without an error.
//
//     const ProjectText file(text);
//     std::string script = file.script(0);                   // as the compiler sees it
//     std::string changed = file.replace(0, 4, 7, "speed");  // bytes of that script
//     std::string with_event = file.add({"event", "ping", 2});
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vagus::aesl {

class ProjectText {
public:
    // An <event> (its value: the number of arguments) or a <constant>.
    struct Definition {
        std::string element;  // "event" or "constant"
        std::string name;
        int32_t value = 0;
    };

    explicit ProjectText(std::string_view text);

    size_t scripts() const { return nodes_.size(); }
    std::string script(size_t index) const;
    // The file with bytes [from, to) of that script replaced. Line feeds become those of the file.
    std::string replace(size_t index, size_t from, size_t to, std::string_view insert) const;

    // The file with one more script, empty, behind the last one.
    std::string add_script(std::string_view node, uint16_t node_id) const;

    // The file with one more definition, behind the last one of its kind; without the one of that
    // name; with another name or value; with it at another place of its list. Nothing if there is
    // none of that name.
    std::string add(const Definition& definition) const;
    std::optional<std::string> remove(std::string_view element, std::string_view name) const;
    std::optional<std::string> change(std::string_view element, std::string_view name,
                                      const Definition& to) const;
    std::optional<std::string> move(std::string_view element, std::string_view name,
                                    size_t to) const;

private:
    // A child of the <network>, as it is in the text.
    struct Element {
        std::string name;
        size_t begin = 0, tag_end = 0, end = 0;  // <, behind the start tag, behind the end
        bool empty = false;                      // <node … />
    };
    // A part of a script's text.
    struct Piece {
        size_t begin = 0, end = 0;
        bool literal = false;  // CDATA
    };

    void scan();
    size_t element_end(size_t tag_end) const;
    std::vector<Piece> pieces(const Element& node) const;
    std::string attribute(const Element& element, std::string_view key) const;
    std::vector<const Element*> definitions(std::string_view element) const;
    const Element* find(std::string_view element, std::string_view name) const;
    std::string line_end() const;
    std::string written(const Definition& definition) const;
    std::string without(const Element& element) const;

    std::string text_;
    std::vector<Element> elements_;
    std::vector<size_t> nodes_;  // indices into elements_
    size_t content_begin_ = 0;   // behind <network>
};

}  // namespace vagus::aesl
