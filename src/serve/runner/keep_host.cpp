#include "serve/runner/keep_host.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/file.hpp"
#include "base/temporary_folder.hpp"
#include "serve/json.hpp"
#include "serve/runner/one_answer.hpp"
#include "trial/kept_run.hpp"

namespace vagus::serve {

namespace {

Result<Json> kept(const std::string& path, const std::string& test) {
    const MappedFile file = TRY(MappedFile::open(path));
    // As pages name it: where it lies on this computer says nothing to them.
    const std::string name = std::filesystem::path(path).filename().string();
    const mcap::Reader reader = TRY(mcap::Reader::open(file.bytes(), name));
    const TemporaryFolder scratch = TRY(TemporaryFolder::make("kept"));
    const trial::KeptRun run =
        TRY(trial::keep_run(reader, {.test = test, .scratch = scratch.path() + "/run.mcap"}));
    return Json{{"text", run.draft.text}, {"differs", run.differs}};
}

}  // namespace

std::string answer_keep(const std::string& question) {
    const Json asked = Json::parse(question, nullptr, false);
    if (!asked.is_object() || !asked.contains("file") || !asked.contains("test")) return "";
    const auto found = kept(asked["file"], asked["test"]);
    return json_text(found.ok() ? found.value() : Json{{"error", found.error().what}});
}

int run_keep(Pipe pipe) {
    return answer_one(std::move(pipe), {kKeepAsked, kKeepAnswered}, answer_keep);
}

}  // namespace vagus::serve
