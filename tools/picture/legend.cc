#include "tools/picture/legend.hh"

#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H

namespace maille::picture {
namespace {

/// The font, at one size. Where the machine doesn't have it, nothing is drawn and every text is 0 wide.
class Font {
  public:
    explicit Font(int pixel_size) {
        FT_Library library = nullptr;
        if (FT_Init_FreeType(&library) != 0) return;
        library_.reset(library);
#ifdef MAILLE_FONT
        FT_Face face = nullptr;
        if (FT_New_Face(library, MAILLE_FONT, 0, &face) != 0) return;
        face_.reset(face);
        FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(pixel_size));
#else
        static_cast<void>(pixel_size);
#endif
    }

    bool is_there() const {
        return face_ != nullptr;
    }

    int width(const std::string& text) const {
        int x = 0;
        for_each_glyph(text, [&](FT_GlyphSlot glyph) { x += static_cast<int>(glyph->advance.x / 64); });
        return x;
    }

    void draw(const std::string& text, int x, int baseline, const Color& ink, Image& image) const {
        for_each_glyph(text, [&](FT_GlyphSlot glyph) {
            const FT_Bitmap& bitmap = glyph->bitmap;
            for (unsigned row = 0; row < bitmap.rows; ++row)
                for (unsigned column = 0; column < bitmap.width; ++column) {
                    const int px = x + glyph->bitmap_left + static_cast<int>(column);
                    const int py = baseline - glyph->bitmap_top + static_cast<int>(row);
                    if (px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
                    const auto cover =
                        bitmap.buffer[static_cast<int>(row) * bitmap.pitch + static_cast<int>(column)];
                    image.at(px, py) = mix(image.at(px, py), ink, static_cast<float>(cover) / 255);
                }
            x += static_cast<int>(glyph->advance.x / 64);
        });
    }

  private:
    template <class Action>
    void for_each_glyph(const std::string& text, const Action& action) const {
        if (!face_) return;
        for (char32_t letter : letters(text))
            if (FT_Load_Char(face_.get(), letter, FT_LOAD_RENDER | FT_LOAD_NO_HINTING) == 0)
                action(face_->glyph);
    }

    /// Code points of UTF-8 text; a byte that isn't UTF-8 stands for itself.
    static std::u32string letters(const std::string& text) {
        std::u32string result;
        for (std::size_t i = 0; i < text.size();) {
            const auto lead = static_cast<unsigned char>(text[i]);
            std::size_t n = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 1;
            if (i + n > text.size()) n = 1;
            char32_t letter = n == 1 ? lead : lead & (0x7fU >> n);
            for (std::size_t k = 1; k < n; ++k)
                letter = (letter << 6) | (static_cast<unsigned char>(text[i + k]) & 0x3fU);
            result += letter;
            i += n;
        }
        return result;
    }

    struct Close {
        void operator()(FT_Library library) const { FT_Done_FreeType(library); }
        void operator()(FT_Face face) const { FT_Done_Face(face); }
    };
    std::unique_ptr<FT_LibraryRec_, Close> library_;
    std::unique_ptr<FT_FaceRec_, Close> face_;
};

/// All lengths of the legend follow from the image's height.
struct Layout {
    explicit Layout(int image_height)
        : text(std::max(9, image_height / 60)), line(text * 7 / 4), swatch(text * 5 / 4), margin(2 * text) {}
    int text, line, swatch, margin;
};

/// As many entries as there is room for; the last line tells how many more there are.
std::vector<Scene::LegendEntry> fitting(const std::vector<Scene::LegendEntry>& entries, int image_height) {
    const Layout layout(image_height);
    const auto room = static_cast<std::size_t>(std::max(1, (image_height - 2 * layout.margin) / layout.line));
    if (entries.size() <= room) return entries;
    std::vector<Scene::LegendEntry> kept(entries.begin(),
                                         entries.begin() + static_cast<std::ptrdiff_t>(room) - 1);
    kept.push_back({Color::Ones(), fmt::format("and {} more", entries.size() - kept.size())});
    return kept;
}

}  // namespace

int legend_width(const std::vector<Scene::LegendEntry>& entries, int image_height) {
    const Layout layout(image_height);
    const Font font(layout.text);
    int widest = 0;
    for (const auto& entry : fitting(entries, image_height))
        widest = std::max(widest, font.width(entry.name));
    return widest == 0 ? 0 : layout.margin + layout.swatch + layout.text + widest;
}

void draw_legend(const std::vector<Scene::LegendEntry>& entries, Image& image) {
    const Layout layout(image.height);
    const Font font(layout.text);
    if (!font.is_there()) return;
    const int left = image.width - legend_width(entries, image.height);
    int top = layout.margin;
    for (const auto& entry : fitting(entries, image.height)) {
        for (int y = top; y < std::min(top + layout.swatch, image.height); ++y)
            for (int x = std::max(0, left); x < std::min(left + layout.swatch, image.width); ++x)
                image.at(x, y) = entry.color;
        font.draw(entry.name, left + layout.swatch + layout.text / 2, top + layout.swatch - layout.text / 4,
                  from_web(0x1c2430), image);
        top += layout.line;
    }
}

}  // namespace maille::picture
