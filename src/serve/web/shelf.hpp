// Where robots of a fleet fetch the version that is wanted of them: one file over HTTPS, under a
// name that nobody can guess, served while this lives (docs/fleet.md, "Another version for many").
//
//     const auto shelf = TRY(Shelf::open({.listen = "0.0.0.0:8443", .host = "desk.local"}, bytes));
//     want.address = shelf->address();
#pragma once

#include <memory>
#include <string>

#include "base/result.hpp"
#include "base/temporary_folder.hpp"
#include "serve/web/server.hpp"

namespace vagus::serve {

struct ShelfOptions {
    std::string listen = {};                 // ADDRESS:PORT; empty: 127.0.0.1, a free port
    std::string host = {};                   // what robots call this computer; empty: its own name
    std::string certificate = {}, key = {};  // PEM files, for HTTPS
    // How the four are said on the command line, for sentences: "--listen", "--serve-cert".
    std::string listen_word = "--listen", certificate_word = "--serve-cert",
                key_word = "--serve-key";
};

class Shelf {
public:
    // The Error says which option is wrong, or is missing: another computer fetches by HTTPS alone.
    static Result<std::unique_ptr<Shelf>> open(const ShelfOptions& options,
                                               const std::string& bytes);
    const std::string& address() const { return address_; }

private:
    explicit Shelf(TemporaryFolder folder);
    Status serve(const ShelfOptions& options);

    TemporaryFolder folder_;  // goes after the server
    const std::string token_;
    std::string address_;
    std::unique_ptr<WebServer> server_;
};

}  // namespace vagus::serve
