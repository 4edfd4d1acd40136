#include "ui/light_icon.h"

#include <cmath>

namespace kilolux {

void drawLightIcon(ImDrawList& canvas, LightType type, ImVec2 c, float r, ImU32 color) {
    const float width = std::max(1.0f, r * 0.22f);
    switch (type) {
    case LightType::Directional:
        canvas.AddCircleFilled(c, 0.45f * r, color, 16);
        for (int i = 0; i < 8; ++i) {
            const float angle = 0.785398f * float(i), x = std::cos(angle), y = std::sin(angle);
            canvas.AddLine({c.x + 0.68f * r * x, c.y + 0.68f * r * y}, {c.x + r * x, c.y + r * y}, color,
                           width);
        }
        break;
    case LightType::Sphere:
        canvas.AddCircleFilled(c, 0.72f * r, color, 20);
        break;
    case LightType::Spot:
        canvas.AddTriangleFilled({c.x, c.y - 0.9f * r}, {c.x + 0.8f * r, c.y + 0.6f * r},
                                 {c.x - 0.8f * r, c.y + 0.6f * r}, color);
        break;
    case LightType::Tube:
        canvas.AddRectFilled({c.x - r, c.y - 0.28f * r}, {c.x + r, c.y + 0.28f * r}, color, 0.28f * r);
        break;
    case LightType::Rect:
        canvas.AddRectFilled({c.x - 0.9f * r, c.y - 0.6f * r}, {c.x + 0.9f * r, c.y + 0.6f * r}, color);
        break;
    case LightType::Disk:
        canvas.PathArcTo(c, 0.8f * r, 0.0f, 3.14159265f, 12);
        canvas.PathFillConvex(color);
        canvas.AddCircle(c, 0.8f * r, color, 20, width);
        break;
    }
}

} // namespace kilolux
