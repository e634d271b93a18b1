#include "vision/classify/confusion.h"

#include "base/error.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace scree::vision {

namespace {

double row_sum(const ConfusionMatrix& matrix, std::size_t truth) {
    double sum = 0.0;
    for (const double count : matrix.counts[truth])
        sum += count;
    return sum;
}

double column_sum(const ConfusionMatrix& matrix, std::size_t found) {
    double sum = 0.0;
    for (const auto& row : matrix.counts)
        sum += row[found];
    return sum;
}

double share(double part, double whole) {
    return whole > 0.0 ? part / whole : 0.0;
}

}  // namespace

void add_to_confusion(ConfusionMatrix& matrix, const Raster<std::uint8_t>& truth,
                      const Raster<std::uint8_t>& found) {
    if (truth.width() != found.width() || truth.height() != found.height())
        fail<InvalidInput>("the truth has ", truth.width(), " x ", truth.height(),
                           " pixels, what was found ", found.width(), " x ", found.height(),
                           "; they must agree");
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const std::size_t is = truth.data()[i];
        const std::size_t called = found.data()[i];
        if (is >= kGroundClasses || called >= kGroundClasses)
            fail<InvalidInput>("pixel ", i, " holds class ", std::max(is, called),
                               ", classes are 0 to ", kGroundClasses - 1);
        matrix.counts[is][called] += 1.0;
    }
}

double accuracy(const ConfusionMatrix& matrix) {
    double right = 0.0;
    double all = 0.0;
    for (std::size_t c = 0; c < kGroundClasses; ++c) {
        right += matrix.counts[c][c];
        all += row_sum(matrix, c);
    }
    return share(right, all);
}

double recall(const ConfusionMatrix& matrix, GroundClass kind) {
    const auto c = static_cast<std::size_t>(kind);
    return share(matrix.counts[c][c], row_sum(matrix, c));
}

double precision(const ConfusionMatrix& matrix, GroundClass kind) {
    const auto c = static_cast<std::size_t>(kind);
    return share(matrix.counts[c][c], column_sum(matrix, c));
}

double mean_overlap(const ConfusionMatrix& matrix) {
    double sum = 0.0;
    double present = 0.0;
    for (std::size_t c = 0; c < kGroundClasses; ++c) {
        const double both = matrix.counts[c][c];
        if (row_sum(matrix, c) == 0.0)
            continue;
        sum += both / (row_sum(matrix, c) + column_sum(matrix, c) - both);
        present += 1.0;
    }
    return share(sum, present);
}

std::string confusion_table(const ConfusionMatrix& matrix) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(1) << "| truth, % called |";
    for (const std::string_view name : kGroundClassNames)
        text << " " << name << " |";
    text << " precision |\n|---|";
    for (std::size_t c = 0; c <= kGroundClasses; ++c)
        text << "---|";
    text << "\n";
    for (std::size_t truth = 0; truth < kGroundClasses; ++truth) {
        text << "| " << kGroundClassNames[truth] << " |";
        for (const double count : matrix.counts[truth])
            text << " " << 100.0 * share(count, row_sum(matrix, truth)) << " |";
        text << " " << 100.0 * precision(matrix, static_cast<GroundClass>(truth)) << " |\n";
    }
    text << "\nright: " << 100.0 * accuracy(matrix) << " % of the pixels; mean overlap "
         << 100.0 * mean_overlap(matrix) << " %\n";
    return text.str();
}

}  // namespace scree::vision
