#include "report/campaign_page.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <set>
#include <stdexcept>

#include "core/errors.hpp"
#include "report/page_files.hpp"
#include "report/page_text.hpp"
#include "tests/report/sample_campaign.hpp"
#include "tests/support/temporary_folder.hpp"

namespace knap {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto place = text.find(part); place != text.npos; place = text.find(part, place + 1)) ++count;
  return count;
}

/// The page without its scripts' code, which is the same in every page.
std::string without_code(std::string html) {
  for (const std::string_view code : {page_files::three_min_js, page_files::fragments_js, page_files::viewer_js,
                                      page_files::runs_table_js, page_files::page_js, page_files::page_css})
    html.replace(html.find(code), code.size(), "");
  return html;
}

class CampaignPageTest : public TemporaryFolder {
 protected:
  std::string written(const CampaignPage& page) {
    write_campaign_page(folder / "report.html", page);
    return content(folder / "report.html");
  }
};

TEST_F(CampaignPageTest, HoldsEverything) {
  const std::string html = written(sample_campaign(folder));
  EXPECT_THAT(html, HasSubstr("<h1>Granules on a wall: &quot;8 &lt; v &amp; v &lt; 48 m/s&quot;</h1>"));
  EXPECT_THAT(html, HasSubstr("<li>No run with &lt;8 m/s&gt; breaks.</li>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"interval\">1.95 … 2.11</td>"));
  EXPECT_THAT(html, HasSubstr("download=\"size &amp; shape.svg\""));
  EXPECT_EQ(occurrences(html, "src=\"data:image/svg+xml;base64,"), 2u);
  EXPECT_EQ(occurrences(html, "src=\"data:image/png;base64,"), 2u) << "the third picture is not there";
  EXPECT_EQ(occurrences(html, "<script type=\"text/plain\" id=\"frame-"), 2u) << "the third frame is not there";
  EXPECT_THAT(html, HasSubstr("Permission is hereby granted, free of charge")) << "the licence of three.js";
}

TEST_F(CampaignPageTest, NoTextBreaksOutOfItsPlace) {
  const std::string html = without_code(written(sample_campaign(folder)));
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, Not(HasSubstr("<b>shown</b>")));
  EXPECT_THAT(html, HasSubstr("\\u003c/script>\\u003cscript>alert(1)\\u003c/script>, \\\"quoted\\\"\\nand more"));
  EXPECT_THAT(html, HasSubstr("{{title}} of which &lt;/title&gt;")) << "texts are no templates";
  // table, frames and its two blobs, three.js, the page's own code
  EXPECT_EQ(occurrences(html, "<script"), 6u);
  EXPECT_EQ(occurrences(html, "</script"), 6u);
  for (const std::string_view code : {page_files::three_min_js, page_files::fragments_js, page_files::viewer_js,
                                      page_files::runs_table_js, page_files::page_js})
    EXPECT_EQ(code.find("</script"), code.npos);
}

TEST_F(CampaignPageTest, LoadsNothing) {
  const std::string html = written(sample_campaign(folder));
  EXPECT_THAT(html, HasSubstr("content=\"default-src 'none'; img-src data: blob:;"));
  std::set<std::string> addresses;
  const std::regex address(R"(https?://[^\s"'<>)]*)");
  for (std::sregex_iterator it(html.begin(), html.end(), address), end; it != end; ++it) addresses.insert(it->str());
  // A namespace, and what a comment of three.js cites.
  addresses.erase("http://www.w3.org/1999/xhtml");
  addresses.erase("https://graphics.stanford.edu/papers/envmap/envmap.pdf");
  EXPECT_THAT(addresses, IsEmpty());
  const std::regex outside(R"re((src|href|action|data)="(?!data:|#)[^"]*")re");
  std::smatch match;
  const std::string rest = without_code(html);
  EXPECT_FALSE(std::regex_search(rest, match, outside)) << match.str();
}

TEST_F(CampaignPageTest, AnEmptyCampaignHasAPage) {
  const std::string html = written({.title = "Nothing yet"});
  EXPECT_THAT(html, HasSubstr("<script type=\"application/json\" id=\"table\">{\"columns\":[],\"rows\":[]"));
  EXPECT_THAT(html, HasSubstr("id=\"frames\">[]</script>"));
}

TEST_F(CampaignPageTest, NamesWhatCannotBeRead) {
  CampaignPage page{.title = "t"};
  page.sections = {{.title = "s", .figures = {{"f", folder / "none.svg", ""}}}};
  const auto complaint = [&] {
    return message_of<InputError>([&] { write_campaign_page(folder / "report.html", page); });
  };
  EXPECT_THAT(complaint(), HasSubstr("none.svg: cannot be read"));
  std::ofstream(folder / "bad.vtu") << "not a frame";
  page.sections.clear();
  page.runs = {{.name = "r", .frame = folder / "bad.vtu"}};
  EXPECT_THAT(complaint(), HasSubstr("bad.vtu: "));
  EXPECT_FALSE(std::filesystem::exists(folder / "report.html"));
}

TEST_F(CampaignPageTest, APlaceThatCannotBeWrittenIsNamed) {
  EXPECT_THAT(message_of<RuntimeFailure>([&] { write_campaign_page(below_a_file("report.html"), {}); }),
              HasSubstr("report.html"));
}

TEST_F(CampaignPageTest, RowsMustFitTheColumns) {
  CampaignPage page;
  page.runs_table = {{"run", "state"}, {{"a"}}, {}};
  EXPECT_THROW(write_campaign_page(folder / "report.html", page), std::invalid_argument);
}

TEST(PageText, Base64) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(PageText, ExpandsTheTemplateOnce) {
  EXPECT_EQ(expanded("a {{x}} b {{y}}{{x}}", {{"x", "{{y}}"}, {"y", "2"}}), "a {{y}} b 2{{y}}");
  EXPECT_THROW(expanded("{{z}}", {}), std::out_of_range);
}

}  // namespace
}  // namespace knap
