// A plan without a world is recorded, then its file is another one, as after a change on the way.
#include "trial/kept_run.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "base/file.hpp"
#include "base/test_folder.hpp"
#include "trial/trial.hpp"

namespace vagus::trial {
namespace {

// a from 0 to SECONDS s, then b, then the end.
std::string plan_of(const std::string& seconds) {
    return R"({ "format": "vagus-plan/1", "name": "P", "toolboxes": ["core"],
  "start": { "actor": "a" },
  "actors": {
    "a": { "template": "Wait", "in": { "seconds": )" +
           seconds + R"( }, "states": { "Done": "b" } },
    "b": { "template": "Log", "in": { "text": "'x'" }, "states": { "Done": "@terminate" } } } })";
}

class KeptRuns : public ::testing::Test {
protected:
    Result<Outcome> run(const std::string& text, const std::string& record) {
        const TestFile test = TRY(read_test(text, folder_ / "P.test.json"));
        return run_trial(test, test.seeds.first, {.record = record});
    }
    void record() {
        const std::string expect = R"("expect":[{"ends":"OK"}]})";
        const auto outcome =
            run(R"({"format":"vagus-test/1","plan":"P.plan.json",)" + expect, folder_ / "run.mcap");
        ASSERT_TRUE(outcome.ok()) << outcome.error().what;
    }
    KeptRun keep() {
        const auto file = MappedFile::open(folder_ / "run.mcap");
        const auto reader = mcap::Reader::open(file.value().bytes(), "run.mcap");
        auto kept = keep_run(reader.value(), {folder_ / "P.test.json", folder_ / "again.mcap"});
        EXPECT_TRUE(kept.ok()) << kept.error().what;
        return std::move(kept.value());
    }
    bool passes(const KeptRun& kept) {
        const auto outcome = run(kept.draft.text, "");
        return outcome.ok() && outcome.value().as_expected();
    }
    static bool says(const KeptRun& kept, const std::string& part) {
        return kept.draft.text.find(part) != std::string::npos;
    }

    test::Folder folder_;
};

TEST_F(KeptRuns, ARunThatComesAboutAgainIsKeptAsItWas) {
    folder_.write("P.plan.json", plan_of("2"));
    record();
    const KeptRun kept = keep();
    EXPECT_FALSE(kept.differs);
    // 2 s and a quarter of room.
    EXPECT_TRUE(says(kept, R"({ "within": 2.5, "eventually": "actor == 'b'" })"))
        << kept.draft.text;
    EXPECT_TRUE(passes(kept));
}

TEST_F(KeptRuns, OneThatDoesNotExpectsWhatTheFilesOfNowDo) {
    folder_.write("P.plan.json", plan_of("2"));
    record();
    folder_.write("P.plan.json", plan_of("8"));
    const KeptRun kept = keep();
    EXPECT_TRUE(kept.differs);
    // Its time, 2.5 s, was over before b came: a is all that there is, at 0.
    EXPECT_TRUE(says(kept, R"({ "order": ["a"] })")) << kept.draft.text;
    EXPECT_TRUE(says(kept, R"({ "ends": "MaxTime" })")) << kept.draft.text;
    EXPECT_TRUE(says(kept, "Made from run.mcap")) << kept.draft.text;
    EXPECT_TRUE(passes(kept));
}

TEST_F(KeptRuns, APlanThatCannotRunNowIsKeptFromItsRecording) {
    folder_.write("P.plan.json", plan_of("2"));
    record();
    folder_.write("P.plan.json", "{ not a plan");
    const KeptRun kept = keep();
    EXPECT_FALSE(kept.differs);
    EXPECT_TRUE(says(kept, R"("order": ["a", "b"])")) << kept.draft.text;
}

}  // namespace
}  // namespace vagus::trial
