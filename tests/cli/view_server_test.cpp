// SPDX-License-Identifier: MIT
// strut view as a server: whom it answers, what it refuses, how it ends, and how it opens a browser.
#include "support/program.h"
#include "support/walks.h"
#include "view_session.h"

#include <arpa/inet.h>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <netinet/in.h>
#include <sstream>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>

namespace strut::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

using Headers = ViewSession::Headers;

class ViewServer : public testing::Test {
 protected:
  ViewServer() { write_clip(here_.file("walk.bvh"), short_walk(0.0)); }
  [[nodiscard]] std::string walk() const { return here_.file("walk.bvh"); }

  Workplace here_;
};

/// Of one that serves: the page's path and that of a question.
struct Paths {
  explicit Paths(const ViewSession& session)
      : page("/" + session.token() + "/"),
        question(page + "api/session"),
        origin("http://127.0.0.1:" + std::to_string(session.port())) {}
  std::string page, question, origin;
};

/// Whether a connection to `port` of `address` is taken.
bool connects(const char* address, int port) {
  const int connection = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(static_cast<std::uint16_t>(port));
  ::inet_pton(AF_INET, address, &place.sin_addr);
  const bool taken = ::connect(connection, reinterpret_cast<sockaddr*>(&place), sizeof place) == 0;
  ::close(connection);
  return taken;
}

// ---- whom it answers ------------------------------------------------------------------------------------------------

TEST_F(ViewServer, ListensToThisMachineAlone) {
  const ViewSession session({walk()});
  EXPECT_TRUE(connects("127.0.0.1", session.port()));
  EXPECT_FALSE(connects("127.0.0.2", session.port()));
}

TEST_F(ViewServer, HasATokenOfItsOwnEveryTime) {
  const ViewSession first({walk()}), second({walk()});
  EXPECT_EQ(first.token().size(), 48U);
  EXPECT_NE(first.token(), second.token());
}

TEST_F(ViewServer, RefusesWhoHasNotTheToken) {
  const ViewSession session({walk()});
  std::string nearly = session.token();
  nearly.back() = nearly.back() == '0' ? '1' : '0';
  for (const std::string& path : {std::string("/"), std::string("/api/session"), "/" + nearly + "/",
                                  "/" + nearly + "/api/session", "/" + session.token().substr(1) + "/api/session",
                                  "/" + session.token() + "0/", "/" + session.token(), std::string("/favicon.ico")}) {
    for (const char* method : {"GET", "HEAD", "OPTIONS"}) {
      EXPECT_EQ(session.request(method, path).status, 403) << method << " " << path;
    }
    EXPECT_EQ(session.request("POST", path, {}, "{}", "application/json").status, 403) << path;
  }
  EXPECT_THAT(session.request("GET", "/").hint(), HasSubstr("strut view printed"));
}

TEST_F(ViewServer, RefusesOtherNamesOfThisMachine) {
  const ViewSession session({walk()});
  const Paths paths(session);
  const std::string port = ":" + std::to_string(session.port());
  for (const std::string& host : {"evil.example" + port, "evil.example" + std::string(), "127.0.0.1" + std::string(),
                                  "127.0.0.2" + port, "127.0.0.1:1" + std::string()}) {
    EXPECT_EQ(session.request("GET", paths.question, {{"Host", host}}).status, 403) << host;
  }
  EXPECT_EQ(session.request("GET", paths.question, {{"Host", "localhost" + port}}).status, 200);
}

TEST_F(ViewServer, RefusesOtherOrigins) {
  const ViewSession session({walk()});
  const Paths paths(session);
  const std::string other_port = "http://127.0.0.1:" + std::to_string(session.port() == 80 ? 81 : 80);
  for (const std::string& origin : {std::string("https://evil.example"), std::string("null"), other_port,
                                    "https" + paths.origin.substr(4), paths.origin + ".evil.example"}) {
    EXPECT_EQ(session.get("session", {{"Origin", origin}}).status, 403) << origin;
    EXPECT_EQ(session.post("session", {}, {{"Origin", origin}}).status, 403) << origin;
    EXPECT_EQ(session.request("GET", paths.page, {{"Origin", origin}}).status, 403) << origin;
  }
  EXPECT_EQ(session.get("session", {{"Origin", paths.origin}}).status, 200);
}

TEST_F(ViewServer, RefusesPagesOfOtherSitesAndIsOpenedFromAnywhere) {
  const ViewSession session({walk()});
  const Paths paths(session);
  const auto from = [](const char* site, const char* mode, const char* destination) {
    return Headers{{"Sec-Fetch-Site", site}, {"Sec-Fetch-Mode", mode}, {"Sec-Fetch-Dest", destination}};
  };
  for (const char* site : {"cross-site", "same-site"}) {
    EXPECT_EQ(session.get("session", from(site, "no-cors", "script")).status, 403);
    EXPECT_EQ(session.get("session", from(site, "navigate", "document")).status, 403);
    EXPECT_EQ(session.request("GET", paths.page, from(site, "no-cors", "image")).status, 403);
    EXPECT_EQ(session.request("GET", paths.page, from(site, "navigate", "iframe")).status, 403);
    EXPECT_EQ(session.request("GET", paths.page, from(site, "navigate", "document")).status, 200);
  }
  EXPECT_EQ(session.request("GET", paths.page, from("none", "navigate", "document")).status, 200);
  EXPECT_EQ(session.get("session", from("same-origin", "cors", "empty")).status, 200);
}

TEST_F(ViewServer, TakesNothingThatAFormCanSend) {
  const ViewSession session({walk()});
  const std::string path = Paths(session).question;
  for (const char* type : {"", "text/plain", "application/x-www-form-urlencoded", "multipart/form-data; boundary=x",
                           "application/jsonp", "text/plain; application/json"}) {
    EXPECT_EQ(session.request("POST", path, {}, "{}", type).status, 415) << type;
    EXPECT_EQ(session.request("PUT", path, {}, "{}", type).status, 415) << type;
  }
  for (const char* type : {"application/json", "application/json; charset=utf-8"}) {
    EXPECT_EQ(session.request("POST", path, {}, "{}", type).status, 404) << type;
  }
}

TEST_F(ViewServer, KnowsNoFilesBesidesItsOwn) {
  const ViewSession session({walk()});
  const std::string page = Paths(session).page;
  for (const std::string path : {"../",
                                 "..",
                                 "%2e%2e/%2e%2e/etc/passwd",
                                 "..%2f..%2fetc%2fpasswd",
                                 "/etc/passwd",
                                 "//etc/passwd",
                                 "walk.bvh",
                                 "api",
                                 "api/",
                                 "api/clips",
                                 "api/clips/",
                                 "api/clips/../session",
                                 "api/clips/..%2f..%2fwalk.bvh",
                                 "api/clips/%2fetc%2fpasswd",
                                 "api/clips/c0/",
                                 "api/clips/c0%00",
                                 "api/clips/c0.bvh",
                                 "api/session/x",
                                 "api/%2e%2e/api/session",
                                 "index.html",
                                 "api/clips/c0%0d%0aX: y"}) {
    const ViewAnswer answer = session.request("GET", page + path);
    EXPECT_EQ(answer.status, 404) << path;
    EXPECT_FALSE(answer.problem().empty()) << path;
  }
  EXPECT_EQ(session.request("GET", page + "api/clips/" + walk()).status, 404);
}

TEST_F(ViewServer, TellsBrowsersToKeepItToThemselves) {
  const ViewSession session({walk()});
  const Paths paths(session);
  for (const std::string& path : {paths.page, paths.question, paths.page + "api/clips/c0", std::string("/")}) {
    const auto headers = session.request("GET", path).headers;
    EXPECT_EQ(headers.at("x-content-type-options"), "nosniff");
    EXPECT_EQ(headers.at("x-frame-options"), "DENY");
    EXPECT_EQ(headers.at("referrer-policy"), "no-referrer");
    EXPECT_EQ(headers.at("cross-origin-resource-policy"), "same-origin");
    EXPECT_EQ(headers.at("cache-control"), "no-store");
    EXPECT_EQ(headers.count("access-control-allow-origin"), 0U);
  }
  const ViewAnswer page = session.request("GET", paths.page);
  EXPECT_THAT(page.headers.at("content-type"), StartsWith("text/html"));
  EXPECT_THAT(page.headers.at("content-security-policy"), HasSubstr("connect-src 'self'"));
}

// ---- what is too much -----------------------------------------------------------------------------------------------

TEST_F(ViewServer, RefusesWhatIsTooLong) {
  const ViewSession session({walk()});
  const std::string page = Paths(session).page;
  EXPECT_EQ(session.request("GET", page + "api/clips/" + std::string(1000, 'c')).status, 414);
  EXPECT_NE(session.request("GET", page + "api/clips/" + std::string(100'000, 'c')).status, 200);
  EXPECT_EQ(session.get("alignment?reference=c0&clip=" + std::string(4000, 'c')).status, 404);
  EXPECT_NE(session.get("session", {{"X", std::string(100'000, 'x')}}).status, 403);
  EXPECT_NE(session.request("POST", page + "api/session", {}, std::string(17U << 20U, ' '), "application/json").status,
            200);
  EXPECT_EQ(session.get("session").status, 200);
}

TEST_F(ViewServer, AnswersWhileOthersKeepConnectionsAndSayNothing) {
  const ViewSession session({walk()});
  std::vector<int> silent;
  for (int i = 0; i < 20; ++i) {
    silent.push_back(::socket(AF_INET, SOCK_STREAM, 0));
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(static_cast<std::uint16_t>(session.port()));
    ::inet_pton(AF_INET, "127.0.0.1", &place.sin_addr);
    ASSERT_EQ(::connect(silent.back(), reinterpret_cast<sockaddr*>(&place), sizeof place), 0);
  }
  EXPECT_EQ(session.get("session").status, 200);
  for (const int connection : silent) ::close(connection);
}

TEST_F(ViewServer, SaysWhatItDoesNotKnowToHead) {
  const ViewSession session({walk()});
  const ViewAnswer head = session.request("HEAD", Paths(session).page + "api/clips/c0");
  EXPECT_EQ(head.status, 200);
  EXPECT_THAT(head.body, IsEmpty());
}

// ---- how it begins and ends -----------------------------------------------------------------------------------------

TEST_F(ViewServer, PrintsTheAddressAloneAndSaysHowItEnds) {
  ViewSession session({walk()});
  EXPECT_TRUE(session.program().is_silent());
  EXPECT_EQ(session.end_with(SIGTERM), 0);
  EXPECT_EQ(session.program().err(), "Ctrl+C ends it.\n");
}

TEST_F(ViewServer, EndsWhenInterrupted) {
  for (const int signal : {SIGINT, SIGTERM}) {
    ViewSession session({walk()});
    EXPECT_EQ(session.get("session").status, 200);
    EXPECT_EQ(session.end_with(signal), 0);
    EXPECT_EQ(session.get("session").status, 0);
  }
}

TEST_F(ViewServer, IsGoneOnceKilled) {
  ViewSession session({walk()});
  EXPECT_EQ(session.get("session").status, 200);
  session.kill();
  EXPECT_EQ(session.get("session").status, 0);
}

TEST_F(ViewServer, RefusesAPortThatIsTaken) {
  const ViewSession session({walk()});
  const std::string port = std::to_string(session.port());
  const ProgramResult second = run_program(STRUT_PROGRAM, {"view", walk(), "--no-browser", "--port", port});
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_THAT(second.err, HasSubstr("port " + port + " of 127.0.0.1 cannot be used"));
}

TEST_F(ViewServer, NeedsAFileAndAPort) {
  EXPECT_EQ(run_program(STRUT_PROGRAM, {"view"}).exit_code, 2);
  EXPECT_EQ(run_program(STRUT_PROGRAM, {"view", walk(), "--port", "70000"}).exit_code, 2);
}

// ---- the browser ----------------------------------------------------------------------------------------------------

/// A folder with an opener that notes what it was given, in place of the system's.
class ViewBrowser : public ViewServer {
 protected:
  /// `ending`: the script's last line.
  ViewSession opened(const std::string& ending = "exit 0") {
    namespace fs = std::filesystem;
    fs::create_directories(here_.file("bin"));
    fs::create_directories(here_.file("run"));
    const std::string noted = here_.file("noted"), opener = here_.file("bin/xdg-open");
    write_file(opener, "#!/bin/sh\nprintf '%s\\n' \"$#\" \"$1\" > '" + noted +
                           ".new'\nstat -c '%a' \"$1\" \"$(dirname \"$1\")\" >> '" + noted + ".new'\ncat \"$1\" >> '" +
                           noted + ".new'\nmv '" + noted + ".new' '" + noted + "'\n" + ending + "\n");
    fs::permissions(opener, fs::perms::owner_all);
    return {"/usr/bin/env",
            {"PATH=" + here_.file("bin") + ":/usr/bin:/bin", "DISPLAY=:9", "XDG_RUNTIME_DIR=" + here_.file("run"),
             STRUT_PROGRAM, "view", walk()}};
  }

  /// What the opener noted: how many arguments, the first, rights of the file and its folder, the file's text.
  [[nodiscard]] std::vector<std::string> noted() const {
    for (int tries = 0; tries < 500 && !std::filesystem::exists(here_.file("noted")); ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    std::vector<std::string> lines;
    std::istringstream text(read_file(here_.file("noted")));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
};

TEST_F(ViewBrowser, IsLedToThePageByAFileThatOnlyThisPersonCanRead) {
  ViewSession session = opened();
  const std::vector<std::string> lines = noted();
  ASSERT_GT(lines.size(), 4U);
  EXPECT_EQ(lines[0], "1");
  EXPECT_THAT(lines[1], StartsWith(here_.file("run")));
  EXPECT_THAT(lines[1], Not(HasSubstr(session.token())));
  EXPECT_EQ(lines[2], "600");
  EXPECT_EQ(lines[3], "700");
  const std::string text = read_file(lines[1]);
  EXPECT_THAT(text, HasSubstr("http-equiv=\"refresh\" content=\"0; url=" + session.address() + "\""));
  EXPECT_EQ(session.end_with(SIGINT), 0);
  EXPECT_TRUE(std::filesystem::is_empty(here_.file("run")));
}

TEST_F(ViewBrowser, IsNotNeeded) {
  ViewSession session = opened("exit 3");
  EXPECT_FALSE(noted().empty());
  std::this_thread::sleep_for(std::chrono::milliseconds(600));  // it is looked for four times a second
  EXPECT_EQ(session.get("session").status, 200);
  EXPECT_EQ(session.end_with(SIGINT), 0);
  EXPECT_THAT(session.program().err(), HasSubstr("note: no browser was opened: none was found"));
}

TEST_F(ViewBrowser, IsNotLookedForWithoutAScreenOrAnOpener) {
  for (const auto& [screen, said] : std::vector<std::pair<std::string, std::string>>{
           {"DISPLAY=", "there is no screen"}, {"DISPLAY=:9", "xdg-open cannot be started"}}) {
    ViewSession session("/usr/bin/env", {"-i", "PATH=" + here_.file("nothing"), screen, STRUT_PROGRAM, "view", walk()});
    EXPECT_EQ(session.get("session").status, 200);
    EXPECT_EQ(session.end_with(SIGINT), 0);
    EXPECT_THAT(session.program().err(), HasSubstr("no browser was opened: " + said));
  }
}

}  // namespace
}  // namespace strut::test
