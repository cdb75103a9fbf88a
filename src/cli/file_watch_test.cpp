#include "cli/file_watch.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace vagus::cli {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

// A file of its own for each test, in the folder for temporary files.
class Watched : public testing::Test {
protected:
    Watched() {
        const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
        path_ = (std::filesystem::temp_directory_path() / ("vagus_watch_" + name)).string();
        write("first");
    }
    ~Watched() override { std::filesystem::remove(path_); }

    // The size differs each time: a file system may have coarse times.
    void write(const std::string& text) const { std::ofstream(path_) << text; }

    std::string path_;
};

TEST_F(Watched, ASavedFileIsToldOnceAfterItRested) {
    FileWatch watch({path_});
    EXPECT_THAT(watch.changed(0ms), IsEmpty());
    write("second text");
    EXPECT_THAT(watch.changed(kLookEvery), IsEmpty());  // it may still be being written
    EXPECT_THAT(watch.changed(2 * kLookEvery), ElementsAre(path_));
    EXPECT_THAT(watch.changed(3 * kLookEvery), IsEmpty());
}

TEST_F(Watched, BetweenTheLooksNothingIsRead) {
    FileWatch watch({path_});
    EXPECT_THAT(watch.changed(0ms), IsEmpty());
    write("second text");
    EXPECT_THAT(watch.changed(kLookEvery - 1ms), IsEmpty());
    EXPECT_THAT(watch.changed(kLookEvery), IsEmpty());
    EXPECT_THAT(watch.changed(2 * kLookEvery - 1ms), IsEmpty());
    EXPECT_THAT(watch.changed(2 * kLookEvery), ElementsAre(path_));
}

// Editors write a new file and rename it over the old one, which is gone in between.
TEST_F(Watched, AFileThatIsReplacedIsNoticed) {
    FileWatch watch({path_});
    EXPECT_THAT(watch.changed(0ms), IsEmpty());
    std::filesystem::remove(path_);
    EXPECT_THAT(watch.changed(1 * kLookEvery), IsEmpty());
    EXPECT_THAT(watch.changed(2 * kLookEvery), IsEmpty());
    write("the replacement");
    EXPECT_THAT(watch.changed(3 * kLookEvery), IsEmpty());
    EXPECT_THAT(watch.changed(4 * kLookEvery), ElementsAre(path_));
}

}  // namespace
}  // namespace vagus::cli
