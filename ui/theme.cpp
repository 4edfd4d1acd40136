// Style and fonts, see theme.h.
#include "ui/theme.h"

#include <algorithm>
#include <filesystem>

namespace kilolux::theme {

namespace {

constexpr const char* kTextFont = "/usr/share/fonts/opentype/inter/Inter-Regular.otf";
constexpr const char* kIconFont = "/usr/share/fonts/truetype/font-awesome/fontawesome-webfont.ttf";
constexpr float kTextPx = 16.0f, kSmallPx = 14.0f; // at scale 1
constexpr ImWchar kIconRange[] = {0xf000, 0xf2e0, 0};
// Latin, Greek (units), Cyrillic, punctuation, arrows and mathematical signs.
constexpr ImWchar kTextRange[] = {0x20,   0x17f,  0x370,  0x3ff,  0x400,  0x52f, 0x2010,
                                  0x205f, 0x2190, 0x21ff, 0x2200, 0x22ff, 0};

// Inter's digits differ in width by default, and ImGui cannot ask for its tabular ones.
void makeDigitsTabular(ImFont& font) {
    float widest = 0.0f;
    for (ImWchar digit = '0'; digit <= '9'; ++digit)
        widest = std::max(widest, font.FindGlyph(digit)->AdvanceX);
    for (ImFontGlyph& glyph : font.Glyphs) {
        if (glyph.Codepoint < '0' || glyph.Codepoint > '9') continue;
        const float shift = 0.5f * (widest - glyph.AdvanceX);
        glyph.X0 += shift;
        glyph.X1 += shift;
        glyph.AdvanceX = widest;
        font.IndexAdvanceX[int(glyph.Codepoint)] = widest;
    }
}

ImFont* addFont(float px) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    if (!std::filesystem::exists(kTextFont)) {
        ImFontConfig config;
        config.SizePixels = px;
        return atlas.AddFontDefault(&config);
    }
    ImFontConfig text;
    text.OversampleH = 2;
    text.PixelSnapH = true;
    ImFont* font = atlas.AddFontFromFileTTF(kTextFont, px, &text, kTextRange);
    if (std::filesystem::exists(kIconFont)) {
        ImFontConfig icons;
        icons.MergeMode = true;
        icons.PixelSnapH = true;
        icons.GlyphMinAdvanceX = px;
        atlas.AddFontFromFileTTF(kIconFont, 0.86f * px, &icons, kIconRange);
    }
    return font;
}

ImVec4 color(ImU32 packed) {
    return ImGui::ColorConvertU32ToFloat4(packed);
}

ImVec4 grey(float value, float alpha = 1.0f) {
    return {value, value, value, alpha};
}

} // namespace

std::optional<Error> loadFonts(double scale) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    addFont(float(kTextPx * scale));
    addFont(float(kSmallPx * scale));
    atlas.Build();
    for (ImFont* font : atlas.Fonts)
        makeDigitsTabular(*font);
    for (const char* path : {kTextFont, kIconFont})
        if (!std::filesystem::exists(path)) return Error{std::string("font missing: ") + path};
    return std::nullopt;
}

ImFont* smallFont() {
    return ImGui::GetIO().Fonts->Fonts[1];
}

void apply(double scale) {
    ImGuiStyle style;
    style.WindowPadding = {12, 8};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 4};
    style.ItemInnerSpacing = {4, 4};
    style.CellPadding = {4, 2};
    style.IndentSpacing = 16;
    style.ScrollbarSize = 12;
    style.GrabMinSize = 12;
    style.WindowRounding = style.ChildRounding = style.TabRounding = 0;
    style.FrameRounding = style.GrabRounding = style.PopupRounding = style.ScrollbarRounding = 3;
    style.WindowBorderSize = style.ChildBorderSize = style.FrameBorderSize = style.TabBorderSize = 0;
    style.PopupBorderSize = 1;
    style.WindowMinSize = {16, 16};
    style.ScaleAllSizes(float(scale));
    ImVec4* colors = style.Colors;
    colors[ImGuiCol_Text] = color(kText);
    colors[ImGuiCol_TextDisabled] = color(kDim);
    colors[ImGuiCol_WindowBg] = colors[ImGuiCol_ChildBg] = color(kBackground);
    colors[ImGuiCol_PopupBg] = grey(0.16f);
    colors[ImGuiCol_Border] = grey(0.24f);
    colors[ImGuiCol_FrameBg] = color(kField);
    colors[ImGuiCol_FrameBgHovered] = grey(0.23f);
    colors[ImGuiCol_FrameBgActive] = grey(0.26f);
    colors[ImGuiCol_TitleBg] = colors[ImGuiCol_TitleBgActive] = colors[ImGuiCol_TitleBgCollapsed] =
        grey(0.13f);
    colors[ImGuiCol_MenuBarBg] = color(kBars);
    colors[ImGuiCol_ScrollbarBg] = grey(0.0f, 0.0f);
    colors[ImGuiCol_ScrollbarGrab] = grey(0.27f);
    colors[ImGuiCol_ScrollbarGrabHovered] = grey(0.34f);
    colors[ImGuiCol_ScrollbarGrabActive] = grey(0.4f);
    colors[ImGuiCol_CheckMark] = colors[ImGuiCol_SliderGrab] = colors[ImGuiCol_SliderGrabActive] =
        color(kAccent);
    colors[ImGuiCol_Button] = grey(0.0f, 0.0f);
    colors[ImGuiCol_ButtonHovered] = grey(0.23f);
    colors[ImGuiCol_ButtonActive] = grey(0.29f);
    colors[ImGuiCol_Header] = color(kAccentDim);
    colors[ImGuiCol_HeaderHovered] = grey(0.23f);
    colors[ImGuiCol_HeaderActive] = grey(0.29f);
    colors[ImGuiCol_Separator] = grey(0.21f);
    colors[ImGuiCol_SeparatorHovered] = colors[ImGuiCol_SeparatorActive] = color(kAccent);
    colors[ImGuiCol_ResizeGrip] = grey(0.0f, 0.0f);
    colors[ImGuiCol_Tab] = grey(0.0f, 0.0f);
    colors[ImGuiCol_TabHovered] = grey(0.23f);
    colors[ImGuiCol_TabActive] = grey(0.2f);
    colors[ImGuiCol_PlotLines] = colors[ImGuiCol_PlotHistogram] = color(kAccent);
    colors[ImGuiCol_TextSelectedBg] = color(IM_COL32(240, 170, 60, 90));
    colors[ImGuiCol_NavHighlight] = color(kAccent);
    colors[ImGuiCol_DragDropTarget] = color(kAccent);
    colors[ImGuiCol_ModalWindowDimBg] = grey(0.0f, 0.45f);
    colors[ImGuiCol_TableRowBg] = grey(0.0f, 0.0f);
    colors[ImGuiCol_TableRowBgAlt] = grey(1.0f, 0.02f);
    colors[ImGuiCol_TableHeaderBg] = grey(0.17f);
    colors[ImGuiCol_TableBorderStrong] = colors[ImGuiCol_TableBorderLight] = grey(0.2f);
    ImGui::GetStyle() = style;
}

} // namespace kilolux::theme
