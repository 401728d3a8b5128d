#include "view/stroke_font.hpp"

#include <array>
#include <cstdint>

namespace triptych {

namespace {

/// Polylines with blanks between, each a row of places; a place is its column (0 to 4) and its row (0 to 8),
/// of which 2 is the line that letters stand on.
constexpr std::array<const char*, 95> ascii = {
    "",                                     // blank
    "2824 2322",                            // !
    "1816 3836",                            // "
    "1317 3337 0444 0646",                  // #
    "4738180716353443321203 2921",          // $
    "0248 08170708 33423233",               // %
    "4216172837352414030212324345",         // &
    "2826",                                 // '
    "38272332",                             // (
    "18272312",                             // )
    "2327 0545 1337 3317",                  // *
    "0545 2327",                            // +
    "232211",                               // ,
    "0545",                                 // -
    "1222 2313 1213 2223",                  // .
    "0248",                                 // /
    "123243473818070312 1337",              // 0
    "172822 1232",                          // 1
    "07183847460242",                       // 2
    "07183847463525 354443321203",          // 3
    "3238 380444",                          // 4
    "480805354443321203",                   // 5
    "4738180703123243443505",               // 6
    "084812",                               // 7
    "150607183847463515 1504031232434435",  // 8
    "031232434738180706 15451506",          // 9
    "2324 2627",                            // :
    "232211 2627",                          // ;
    "370533",                               // <
    "0343 0646",                            // =
    "174513",                               // >
    "071838474625 2423",                    // ?
    "32120307183847434324",                 // @
    "022842 0535",                          // A
    "02083847463505 3544433202",            // B
    "4738180703123243",                     // C
    "02082846442202",                       // D
    "48080242 0535",                        // E
    "480802 0535",                          // F
    "473818070312324345 4525",              // G
    "0208 4248 0545",                       // H
    "1232 1838 2228",                       // I
    "0312324348",                           // J
    "0208 480542",                          // K
    "080242",                               // L
    "0208254842",                           // M
    "02084248",                             // N
    "123243473818070312",                   // O
    "02083847463505",                       // P
    "123243473818070312 2442",              // Q
    "02083847463505 2542",                  // R
    "473818070615354443321203",             // S
    "0848 2228",                            // T
    "080312324348",                         // U
    "082248",                               // V
    "0812253248",                           // W
    "0248 0842",                            // X
    "082548 2522",                          // Y
    "08480242",                             // Z
    "38181232",                             // [
    "0842",                                 // backslash
    "18383212",                             // ]
    "162836",                               // ^
    "0141",                                 // _
    "1827",                                 // `
    "16364542 441403123243",                // a
    "0802 0516364543321203",                // b
    "4536160503123243",                     // c
    "4842 4536160503123243",                // d
    "04444536160503123243",                 // e
    "38281712 0636",                        // f
    "4641301001 4536160503123243",          // g
    "0802 0516364542",                      // h
    "2622 2728",                            // i
    "262110 2728",                          // j
    "0802 360442",                          // k
    "282332",                               // l
    "0206 05162522 25364542",               // m
    "0206 0516364542",                      // n
    "123243453616050312",                   // o
    "0600 0516364543321203",                // p
    "4640 4536160503123243",                // q
    "0206 051636",                          // r
    "46160514344332 3202",                  // s
    "282332 1636",                          // t
    "0603123243 4642",                      // u
    "062246",                               // v
    "0612243246",                           // w
    "0246 0642",                            // x
    "0622 461000",                          // y
    "06460242",                             // z
    "3828252515 252332",                    // {
    "2821",                                 // |
    "1828252535 252312",                    // }
    "05163445",                             // ~
};

/// Of no letter that the font has.
constexpr const char* box = "0208484202";
constexpr const char* dots = "1719 3739";

struct Letter {
  const char* strokes = box;
  const char* above = "";
};

Letter letter_of(char32_t code) {
  switch (code) {
    case U'°':
      return {"1636381816", ""};
    case U'²':
      return {"1828271626", ""};
    case U'−':
      return {"0545", ""};
    case U'ä':
    case U'ö':
    case U'ü':
    case U'Ä':
    case U'Ö':
    case U'Ü': {
      const char base = code == U'ä'   ? 'a'
                        : code == U'ö' ? 'o'
                        : code == U'ü' ? 'u'
                        : code == U'Ä' ? 'A'
                        : code == U'Ö' ? 'O'
                                       : 'U';
      return {ascii[static_cast<size_t>(base - ' ')], dots};
    }
    case U'ß':
      return {"02071838473544433222", ""};
    default:
      return code >= U' ' && code <= U'~' ? Letter{ascii[static_cast<size_t>(code - U' ')], ""} : Letter{};
  }
}

/// Of UTF-8; bytes that are none count one by one.
std::vector<char32_t> letters_of(std::string_view text) {
  std::vector<char32_t> letters;
  for (size_t i = 0; i < text.size();) {
    const auto byte = [&](size_t k) { return static_cast<unsigned char>(text[k]); };
    const unsigned char first = byte(i);
    const size_t length = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : first >= 0xc0 ? 2 : 1;
    char32_t code = length == 1 ? first : first & (0x7fu >> length);
    bool whole = i + length <= text.size();
    for (size_t k = 1; whole && k < length; ++k) {
      whole = (byte(i + k) & 0xc0) == 0x80;
      code = code << 6 | (byte(i + k) & 0x3fu);
    }
    letters.push_back(whole ? code : U'\xfffd');
    i += whole ? length : 1;
  }
  return letters;
}

void add(const char* strokes, double shift, std::vector<Stroke>& all) {
  bool goes_on = false;
  glm::dvec2 before(0);
  for (; *strokes; ++strokes) {
    if (*strokes == ' ') {
      goes_on = false;
      continue;
    }
    const glm::dvec2 at(shift + (strokes[0] - '0'), strokes[1] - '0');
    ++strokes;
    if (goes_on) all.emplace_back(before, at);
    goes_on = true;
    before = at;
  }
}

}  // namespace

std::vector<Stroke> strokes_of(std::string_view text) {
  std::vector<Stroke> all;
  double shift = 0;
  for (const char32_t code : letters_of(text)) {
    const Letter letter = letter_of(code);
    add(letter.strokes, shift, all);
    add(letter.above, shift, all);
    shift += font_advance;
  }
  return all;
}

double text_width(std::string_view text) {
  return font_advance * static_cast<double>(letters_of(text).size());
}

}  // namespace triptych
