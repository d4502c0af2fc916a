// The server of the studio: HTTP and WebSocket on a loopback address. Only its .cpp includes Beast.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace forage::studio {

/// A file that the server answers with.
struct Content {
    std::string type, body;  ///< media type, and bytes
    bool gzip = false;       ///< whether the bytes are compressed
    int status = 200;
};

/// Checks every request as docs/design/studio-protocol.md says: the host, the origin, the secrets, the sizes.
class HttpServer {
  public:
    struct Options {
        std::uint16_t port = 0;   ///< 0: a free one
        std::string token;        ///< lets pages connect
        std::string ticket;       ///< lets one page connect once; may be empty
        std::string picture_key;  ///< part of the addresses of pictures
        /// The file for a path such as "/assets/app.js"; empty when there is none.
        std::function<std::optional<Content>(const std::string& path)> file;
        /// Makes a picture, and calls `done` with it, from any thread.
        std::function<void(std::string what, std::string format, std::function<void(Content)> done)> picture;
        std::function<void(int client)> opened, closed;  ///< a page has connected, or is gone
        /// A message of a page; handled() must follow. While many wait, pages are not read.
        std::function<void(int client, std::string text)> received;
    };
    /// Listens. Throws std::runtime_error when the port is taken.
    explicit HttpServer(Options options);
    ~HttpServer();

    std::uint16_t port() const;
    /// Serves until stop() is called.
    void run();
    void stop();  ///< may be called by any thread
    /// Sends a message to a page; may be called by any thread. A page that does not read is disconnected when
    /// too much waits for it.
    void send(int client, bool binary, std::string data);
    /// A message of so many bytes has been dealt with. May be called by any thread.
    void handled(std::size_t bytes);

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace forage::studio
