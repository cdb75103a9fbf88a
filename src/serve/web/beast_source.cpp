// All of Boost.Beast, and of TLS in Boost.Asio, that is no template, compiled once.
#include <boost/asio/ssl/impl/src.hpp>
#include <boost/beast/src.hpp>
