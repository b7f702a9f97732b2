// SPDX-License-Identifier: BSD-3-Clause
#include "tests/study/presentation/x_picture.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <stdexcept>

namespace limen::test {

XPicture pictureOfScreen(const std::string& display) {
  Display* server = XOpenDisplay(display.c_str());
  if (!server) throw std::runtime_error("no X server");
  XPicture out{DisplayWidth(server, 0), DisplayHeight(server, 0), {}};
  XImage* image = XGetImage(server, DefaultRootWindow(server), 0, 0, static_cast<unsigned>(out.width),
                            static_cast<unsigned>(out.height), AllPlanes, ZPixmap);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const unsigned long pixel = XGetPixel(image, x, y);
      out.codes.emplace_back((pixel >> 16) & 255, (pixel >> 8) & 255, pixel & 255);
    }
  XDestroyImage(image);
  XCloseDisplay(server);
  return out;
}

SelectionOwner::SelectionOwner(const std::string& display, const std::string& selection) {
  Display* server = XOpenDisplay(display.c_str());
  if (!server) throw std::runtime_error("no X server");
  display_ = server;
  const Window window = XCreateSimpleWindow(server, DefaultRootWindow(server), 0, 0, 1, 1, 0, 0, 0);
  XSetSelectionOwner(server, XInternAtom(server, selection.c_str(), False), window, CurrentTime);
  XSync(server, False);
}

SelectionOwner::~SelectionOwner() { XCloseDisplay(static_cast<Display*>(display_)); }

}  // namespace limen::test
