#include "testdata/other_pictures.h"

#include "base/error.h"

#include <gmock/gmock.h>

namespace scree::test {
namespace {

TEST(OtherPictures, SameSeedGivesTheSameBytesAndSubjectsDiffer) {
    std::vector<Photo> all;
    for (std::size_t i = 0; i < std::size(kSubjectNames); ++i) {
        const auto subject = static_cast<Subject>(i);
        const Photo photo = draw_subject(subject, 150, 110);
        ASSERT_EQ(photo.width(), 150);
        ASSERT_EQ(photo.height(), 110);
        EXPECT_EQ(photo, draw_subject(subject, 150, 110)) << kSubjectNames[i];
        for (const Photo& other : all)
            EXPECT_NE(photo, other) << kSubjectNames[i];
        all.push_back(photo);
    }
    EXPECT_NE(draw_subject(Subject::Grass, 150, 110, 1), draw_subject(Subject::Grass, 150, 110, 2));
}

TEST(OtherPictures, RefuseAbsurdSizes) {
    EXPECT_THROW(draw_subject(Subject::Face, 0, 100), InvalidOption);
    EXPECT_THROW(draw_subject(Subject::Text, 100, 100000), InvalidOption);
}

}  // namespace
}  // namespace scree::test
