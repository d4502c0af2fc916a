#include "tools/studio/server/http_server.h"

#include <deque>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>  // Boost 1.74 needs it in C++20

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <fmt/format.h>

#include "tools/studio/server/requests.h"

namespace forage::studio {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;

constexpr std::size_t max_header = 16u << 10;        ///< bytes of a request
constexpr std::size_t max_message = 8u << 20;        ///< bytes of a message of a page
constexpr std::size_t max_first_message = 1u << 10;  ///< bytes of the message with the token
constexpr std::size_t max_unsent = 16u << 20;        ///< bytes that wait for a page
constexpr std::size_t max_unhandled = 8u << 20;      ///< bytes of messages that wait for the engine
constexpr std::size_t max_unhandled_messages = 256;
constexpr std::size_t max_pages = 64, max_guests = 64;
constexpr auto answer_time = std::chrono::seconds(30);         ///< for a response to be taken
constexpr auto guest_time = std::chrono::seconds(5);           ///< for a request, or for the token of a page
constexpr auto accept_pause = std::chrono::milliseconds(200);  ///< when no connection can be accepted

/// Whether `given` is the secret, in a time that does not depend on where they differ. An empty secret admits
/// no page.
bool is_secret(std::string_view given, std::string_view secret) {
    if (given.size() != secret.size() || secret.empty()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < given.size(); ++i) difference |= static_cast<unsigned>(given[i] ^ secret[i]);
    return difference == 0;
}

}  // namespace

struct HttpServer::Parts {
    class Page;
    class Connection;

    explicit Parts(Options given)
        : options(std::move(given)),
          acceptor(io, {asio::ip::address_v4::loopback(), options.port}),
          port(acceptor.local_endpoint().port()) {}

    void accept();
    /// Whether a page with this token may connect. A ticket is used up.
    bool admits(const std::string& token) {
        if (is_secret(token, options.token)) return true;
        const bool has_ticket = is_secret(token, options.ticket);
        if (has_ticket) options.ticket.clear();
        return has_ticket;
    }
    bool may_see_pictures(std::string_view target) const {
        return is_secret(query_value(target, "key"), options.picture_key) ||
               is_secret(query_value(target, "token"), options.token);
    }
    /// Notes a connection that has shown no secret, and closes the oldest of too many.
    std::uint64_t add_guest(std::function<void()> close) {
        guests[++last_guest] = std::move(close);
        if (guests.size() > max_guests) {
            const auto close_oldest = std::move(guests.begin()->second);
            guests.erase(guests.begin());
            close_oldest();
        }
        return last_guest;
    }
    bool is_flooded() const {
        return unhandled >= max_unhandled || unhandled_messages >= max_unhandled_messages;
    }

    Options options;
    std::map<std::uint64_t, std::function<void()>> guests;  ///< before `io`, whose end destroys connections
    std::uint64_t last_guest = 0;
    asio::io_context io{1};
    tcp::acceptor acceptor;
    asio::steady_timer retry{io};
    std::uint16_t port;
    std::map<int, std::shared_ptr<Page>> pages;
    std::set<int> unread;  ///< pages that are not read until messages are handled
    std::size_t unhandled = 0, unhandled_messages = 0;
    int next_page = 1;
};

/// The WebSocket of a page.
class HttpServer::Parts::Page : public std::enable_shared_from_this<Page> {
  public:
    Page(Parts& server, tcp::socket socket) : server_(server), socket_(std::move(socket)) {}
    ~Page() { server_.guests.erase(guest_); }

    void begin(const http::request<http::string_body>& request) {
        guest_ = server_.add_guest([page = weak_from_this()] {
            if (const auto self = page.lock()) self->end();
        });
        deadline_.expires_after(guest_time);
        deadline_.async_wait([page = weak_from_this()](beast::error_code error) {
            if (const auto self = page.lock(); self && !error && self->number_ == 0) self->end();
        });
        socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
        socket_.read_message_max(max_first_message);
        socket_.auto_fragment(false);
        socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
            if (!error) self->read_token();
        });
    }
    void send(bool binary, std::string data) {
        waiting_bytes_ += data.size();
        if (waiting_bytes_ > max_unsent) return end();
        waiting_.emplace_back(binary, std::move(data));
        if (waiting_.size() == 1) write();
    }
    void end() {
        server_.unread.erase(number_);
        if (server_.pages.erase(number_) > 0) server_.options.closed(number_);
        beast::error_code ignored;
        beast::get_lowest_layer(socket_).socket().close(ignored);
    }
    /// Reads the next message, unless too many wait for the engine.
    void read() {
        if (server_.is_flooded()) return static_cast<void>(server_.unread.insert(number_));
        socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
            if (error || !self->socket_.got_text()) return self->end();
            std::string text = self->take();
            self->server_.unhandled += text.size(), ++self->server_.unhandled_messages;
            self->server_.options.received(self->number_, std::move(text));
            self->read();
        });
    }

  private:
    std::string take() {
        std::string text = beast::buffers_to_string(buffer_.data());
        buffer_.clear();
        buffer_.shrink_to_fit();
        return text;
    }
    void read_token() {
        socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
            auto& server = self->server_;
            if (error || !self->socket_.got_text()) return self->end();
            if (!server.admits(token_in(self->take())))
                return self->refuse(
                    "This tab has no key: the address bar hides it. Use the studio's first tab, or the "
                    "address that 'forage studio' printed.");
            if (server.pages.size() >= max_pages) return self->refuse("Too many pages are open.");
            server.guests.erase(self->guest_);
            self->deadline_.cancel();
            self->socket_.read_message_max(max_message);
            self->number_ = server.next_page++;
            server.pages[self->number_] = self;
            // A page that came with a ticket connects again with the token.
            self->send(false, fmt::format(R"({{"type": "welcome", "token": "{}"}})", server.options.token));
            server.options.opened(self->number_);
            self->read();
        });
    }
    /// Closes the socket with a reason that the page shows. The deadline holds for this, too.
    void refuse(const char* why) {
        socket_.async_close({websocket::close_code::policy_error, why},
                            [self = shared_from_this()](beast::error_code) { self->end(); });
    }
    void write() {
        socket_.binary(waiting_.front().first);
        socket_.async_write(asio::buffer(waiting_.front().second),
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                                if (error) return self->end();
                                self->waiting_bytes_ -= self->waiting_.front().second.size();
                                self->waiting_.pop_front();
                                if (!self->waiting_.empty()) self->write();
                            });
    }

    Parts& server_;
    websocket::stream<beast::tcp_stream> socket_;
    beast::flat_buffer buffer_;
    std::deque<std::pair<bool, std::string>> waiting_;
    std::size_t waiting_bytes_ = 0;
    asio::steady_timer deadline_{server_.io};  ///< for the token
    std::uint64_t guest_ = 0;
    int number_ = 0;  ///< 0 before the token
};

/// A connection that asks for files, until it becomes a page.
class HttpServer::Parts::Connection : public std::enable_shared_from_this<Connection> {
  public:
    Connection(Parts& server, tcp::socket socket) : server_(server), stream_(std::move(socket)) {}
    ~Connection() { server_.guests.erase(guest_); }

    void begin() {
        guest_ = server_.add_guest([connection = weak_from_this()] {
            if (const auto self = connection.lock()) self->stream_.close();
        });
        read();
    }

  private:
    void read() {
        parser_.emplace();
        parser_->header_limit(max_header);
        parser_->body_limit(0);
        stream_.expires_after(guest_time);
        http::async_read(
            stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
                if (error == http::error::header_limit || error == http::error::body_limit)
                    return self->answer({"text/plain", "The request is too large.\n", false, 413});
                if (error) return;
                self->request_ = self->parser_->release();
                self->handle();
            });
    }
    void handle() {
        const auto view = [&](auto field) {
            const auto value = request_[field];
            return std::string_view(value.data(), value.size());
        };
        const std::string_view target(request_.target().data(), request_.target().size());
        const std::string path(target.substr(0, target.find('?')));
        if (request_.count(http::field::host) != 1 || request_.count(http::field::origin) > 1 ||
            !is_from_here(view(http::field::host), view(http::field::origin), server_.port))
            return refuse(403, "This address is for pages of this machine.");
        if (request_.method() != http::verb::get) return refuse(405, "Only GET is served.");
        if (path == "/ws") {
            if (!websocket::is_upgrade(request_)) return refuse(400, "This is a WebSocket.");
            stream_.expires_never();
            server_.guests.erase(guest_);
            return std::make_shared<Page>(server_, stream_.release_socket())->begin(request_);
        }
        if (path == "/picture") {
            if (!server_.may_see_pictures(target))
                return refuse(403, "The address of a picture has a key, which pages get.");
            server_.guests.erase(guest_);
            stream_.expires_never();
            const std::string format = query_value(target, "format");
            return server_.options.picture(query_value(target, "what"), format.empty() ? "png" : format,
                                           [self = shared_from_this()](Content content) {
                                               asio::post(self->server_.io,
                                                          [self, content = std::move(content)]() mutable {
                                                              self->answer(std::move(content));
                                                          });
                                           });
        }
        auto file = server_.options.file(path);
        if (!file) return refuse(404, "There is no such file.");
        answer(std::move(*file));
    }
    void refuse(int status, const char* why) {
        answer({"text/plain; charset=utf-8", std::string(why) + "\n", false, status});
    }
    void answer(Content content) {
        http::response<http::string_body> out{static_cast<http::status>(content.status), request_.version()};
        out.set(http::field::content_type, content.type);
        if (content.gzip) out.set(http::field::content_encoding, "gzip");
        out.body() = std::move(content.body);
        write(std::move(out));
    }
    void write(http::response<http::string_body> out) {
        out.set(http::field::cache_control, "no-store");
        out.set("Content-Security-Policy",
                "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
                "connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
        out.set("X-Content-Type-Options", "nosniff");
        out.set("Referrer-Policy", "no-referrer");
        out.set("Cross-Origin-Resource-Policy", "same-origin");
        out.keep_alive(out.result_int() < 400 && request_.keep_alive());
        out.prepare_payload();
        response_ = std::move(out);
        stream_.expires_after(answer_time);
        http::async_write(stream_, response_,
                          [self = shared_from_this()](beast::error_code error, std::size_t) {
                              if (!error && self->response_.keep_alive()) return self->read();
                              beast::error_code ignored;
                              self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                          });
    }

    Parts& server_;
    beast::tcp_stream stream_;
    beast::flat_buffer buffer_{max_header};
    std::optional<http::request_parser<http::string_body>> parser_;
    http::request<http::string_body> request_;
    http::response<http::string_body> response_;
    std::uint64_t guest_ = 0;
};

void HttpServer::Parts::accept() {
    acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
        if (error == asio::error::operation_aborted) return;
        if (!error) {
            beast::error_code ignored;
            socket.set_option(tcp::no_delay(true), ignored);
            std::make_shared<Connection>(*this, std::move(socket))->begin();
            return accept();
        }
        // Such as too many open files: an attempt at once would fail again.
        retry.expires_after(accept_pause);
        retry.async_wait([this](beast::error_code stopped) {
            if (!stopped) accept();
        });
    });
}

HttpServer::HttpServer(Options options) try : parts_(std::make_unique<Parts>(std::move(options))) {
    parts_->accept();
} catch (const boost::system::system_error& e) {
    throw std::runtime_error(fmt::format("cannot listen on 127.0.0.1:{}: {}", options.port, e.what()));
}
HttpServer::~HttpServer() = default;

std::uint16_t HttpServer::port() const { return parts_->port; }
void HttpServer::run() { parts_->io.run(); }
void HttpServer::stop() { parts_->io.stop(); }

void HttpServer::send(int client, bool binary, std::string data) {
    asio::post(parts_->io, [parts = parts_.get(), client, binary, data = std::move(data)]() mutable {
        if (const auto it = parts->pages.find(client); it != parts->pages.end()) {
            const auto page = it->second;  // a page that ends leaves the map
            page->send(binary, std::move(data));
        }
    });
}

void HttpServer::handled(std::size_t bytes) {
    asio::post(parts_->io, [parts = parts_.get(), bytes] {
        parts->unhandled -= bytes, --parts->unhandled_messages;
        if (parts->is_flooded()) return;
        for (const int page : std::exchange(parts->unread, {})) parts->pages.at(page)->read();
    });
}

}  // namespace forage::studio
