// Error of the shown view against the time that it took, a curve for each quality preset that was shown.
// Knows no screen.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace kilolux {

struct ErrorPoint {
    std::uint32_t frames = 0; // in the picture
    double seconds = 0.0;     // that many frames take
    double flip = 0.0;        // what is plotted: of what the display shows, 0 to 1
    double relativeMse = 0.0; // of light
    std::uint32_t referenceFrames =
        0; // with fewer than the picture's the reference's own noise is in the error
    bool isCertain() const { return referenceFrames >= frames; }
};

struct ErrorCurve {
    std::string preset; // empty: settings of nobody's
    double frameMs = 0.0;
    std::vector<ErrorPoint> points; // by frames, rising
};

class SpeedError {
  public:
    // Curves of another view are forgotten.
    void setView(std::uint64_t key);
    // A curve that has been there begins anew.
    void begin(const std::string& preset);
    // Of the preset that began last; a point of as many frames is replaced.
    void add(const ErrorPoint& point, double frameMs);

    const std::vector<ErrorCurve>& curves() const { return curves_; }
    const ErrorCurve* curveOf(const std::string& preset) const; // null: none
    const ErrorCurve* present() const { return curveOf(preset_); }

    // What the axes span: whole decades around all points; false: there are none.
    struct Axes {
        std::array<double, 2> seconds{}, error{};
    };
    bool axes(Axes& axes) const;

  private:
    std::uint64_t key_ = 0;
    std::string preset_;
    std::vector<ErrorCurve> curves_;
};

// 0 to 1 of a value between the ends of a logarithmic axis.
double axisPosition(const std::array<double, 2>& ends, double value);

} // namespace kilolux
