// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/gphoto_link.h"

#include <fcntl.h>
#include <gphoto2/gphoto2.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <span>
#include <utility>

#include "core/device/gphoto_words.h"
#include "core/device/whole_jpeg.h"

namespace gyre {
namespace {

constexpr const char* kNetworkModel = "PTP/IP Camera";
// A second file of the same shot (raw and JPEG) is told within this time.
constexpr int kSecondFile_ms = 1500;
constexpr int kEventSlice_ms = 250;

// Owns a handle of the library that counts its users.
template <class Handle, int (*release)(Handle*)>
struct Releaser {
  void operator()(Handle* handle) const { release(handle); }
};
using FileHandle = std::unique_ptr<CameraFile, Releaser<CameraFile, gp_file_unref>>;
using WidgetHandle = std::unique_ptr<CameraWidget, Releaser<CameraWidget, gp_widget_unref>>;
using ListHandle = std::unique_ptr<CameraList, Releaser<CameraList, gp_list_unref>>;

FileHandle newFile() {
  CameraFile* file = nullptr;
  return gp_file_new(&file) == GP_OK ? FileHandle(file) : nullptr;
}

// What one control is called by cameras of several makers.
struct Names {
  const char* name;
  std::array<const char*, 3> widgets;
};
constexpr Names kFocus{"focus", {"focusmode", "focusmode2", nullptr}};
constexpr Names kExposure{"exposure", {"shutterspeed", "shutterspeed2", "exptime"}};
constexpr Names kAperture{"aperture", {"f-number", "aperture", nullptr}};
constexpr Names kGain{"gain", {"iso", "isospeed", nullptr}};
constexpr Names kWhiteBalance{"white balance", {"whitebalance", nullptr, nullptr}};
constexpr Names kProgram{"program", {"expprogram", "autoexposuremode", "autoexposuremodedial"}};

}  // namespace

struct GphotoLink::Library {
  Camera* camera = nullptr;
  GPContext* context = nullptr;
  std::string model;

  WidgetHandle widget(const Names& names) const;
  std::optional<std::string> value(const Names& names) const;
  bool choose(const Names& names, std::span<const char* const> words) const;
};

WidgetHandle GphotoLink::Library::widget(const Names& names) const {
  for (const char* name : names.widgets) {
    CameraWidget* found = nullptr;
    if (name != nullptr && gp_camera_get_single_config(camera, name, &found, context) == GP_OK) {
      return WidgetHandle(found);
    }
  }
  return nullptr;
}

std::optional<std::string> GphotoLink::Library::value(const Names& names) const {
  const WidgetHandle found = widget(names);
  if (!found) return std::nullopt;
  CameraWidgetType type{};
  gp_widget_get_type(found.get(), &type);
  if (type == GP_WIDGET_RANGE) {
    float number = 0.0F;
    if (gp_widget_get_value(found.get(), &number) != GP_OK) return std::nullopt;
    return std::to_string(number);
  }
  if (type != GP_WIDGET_RADIO && type != GP_WIDGET_MENU && type != GP_WIDGET_TEXT) {
    return std::nullopt;
  }
  const char* text = nullptr;
  if (gp_widget_get_value(found.get(), &text) != GP_OK || text == nullptr) return std::nullopt;
  return std::string(text);
}

// Sets the control to the first of the words that it offers; false when it offers none.
bool GphotoLink::Library::choose(const Names& names, std::span<const char* const> words) const {
  const WidgetHandle found = widget(names);
  int read_only = 0;
  if (!found || (gp_widget_get_readonly(found.get(), &read_only) == GP_OK && read_only != 0)) {
    return false;
  }
  for (int i = 0; i < gp_widget_count_choices(found.get()); ++i) {
    const char* choice = nullptr;
    if (gp_widget_get_choice(found.get(), i, &choice) != GP_OK) continue;
    const auto fits = [&](const char* word) { return lowerCase(choice) == word; };
    if (std::none_of(words.begin(), words.end(), fits)) continue;
    const char* name = nullptr;
    gp_widget_get_name(found.get(), &name);
    return gp_widget_set_value(found.get(), choice) == GP_OK &&
           gp_camera_set_single_config(camera, name, found.get(), context) == GP_OK;
  }
  return false;
}

namespace {

// The library's own search by name and port.
int describePort(const std::string& path, GPPortInfoList* ports, GPPortInfo& info) {
  int code = gp_port_info_list_load(ports);
  if (code < GP_OK) return code;
  const int index = gp_port_info_list_lookup_path(ports, path.c_str());
  if (index < GP_OK) return index;
  code = gp_port_info_list_get_info(ports, index, &info);
  return code;
}

int setPort(Camera* camera, const std::string& path) {
  GPPortInfoList* ports = nullptr;
  int code = gp_port_info_list_new(&ports);
  if (code < GP_OK) return code;
  GPPortInfo info{};
  code = describePort(path, ports, info);
  if (code >= GP_OK) code = gp_camera_set_port_info(camera, info);
  gp_port_info_list_free(ports);
  return code;
}

int setModel(Camera* camera, const std::string& model, GPContext* context) {
  CameraAbilitiesList* all = nullptr;
  int code = gp_abilities_list_new(&all);
  if (code < GP_OK) return code;
  code = gp_abilities_list_load(all, context);
  const int index = code < GP_OK ? code : gp_abilities_list_lookup_model(all, model.c_str());
  CameraAbilities abilities;
  code = index < GP_OK ? index : gp_abilities_list_get_abilities(all, index, &abilities);
  if (code >= GP_OK) code = gp_camera_set_abilities(camera, abilities);
  gp_abilities_list_free(all);
  return code;
}

struct FoundCamera {
  std::string model;
  std::string port;
};

// The first camera on a cable, or the one at the port.
std::optional<FoundCamera> detect(const std::string& port, GPContext* context) {
  CameraList* raw = nullptr;
  if (gp_list_new(&raw) != GP_OK) return std::nullopt;
  const ListHandle list(raw);
  if (gp_camera_autodetect(raw, context) < GP_OK) return std::nullopt;
  for (int i = 0; i < gp_list_count(raw); ++i) {
    const char* model = nullptr;
    const char* path = nullptr;
    if (gp_list_get_name(raw, i, &model) != GP_OK || gp_list_get_value(raw, i, &path) != GP_OK) {
      continue;
    }
    if (port.empty() ? std::string(path).starts_with("usb:") : port == path) {
      return FoundCamera{model, path};
    }
  }
  return std::nullopt;
}

// A connection that libgphoto2 2.5.30 fails to make ends with a close() of descriptor 0 that it
// never opened. Were the place left free, the next file of the program would get it, and the next
// failure would close that file.
void refillStandardInput() {
  if (::fcntl(STDIN_FILENO, F_GETFD) != -1) return;
  const int lowest_free = ::open("/dev/null", O_RDONLY);
  if (lowest_free > STDIN_FILENO) ::close(lowest_free);  // somebody was faster
}

bool isLost(int code) {
  return code <= GP_ERROR_IO || code == GP_ERROR_TIMEOUT;  // all I/O codes lie below GP_ERROR_IO
}

}  // namespace

GphotoLink::GphotoLink(std::string word)
    : word_(std::move(word)), library_(std::make_unique<Library>()) {
  library_->context = gp_context_new();
  gp_context_set_cancel_func(
      library_->context,
      [](GPContext*, void* giving_up) {
        return static_cast<std::atomic<bool>*>(giving_up)->load() ? GP_CONTEXT_FEEDBACK_CANCEL
                                                                  : GP_CONTEXT_FEEDBACK_OK;
      },
      &giving_up_);
}

GphotoLink::~GphotoLink() {
  close();
  gp_context_unref(library_->context);
}

Result<std::unique_ptr<GphotoLink>> GphotoLink::forWord(const std::string& word) {
  const bool network = word.starts_with("ptpip:") && word.size() > 6 && word[6] != ':';
  if (!network && !word.starts_with("gphoto:")) {
    return Error{Error::Code::kInvalidInput, "\"" + word + "\" names no still camera.",
                 "Write gphoto: for the one on the USB cable, or ptpip:HOST."};
  }
  return std::unique_ptr<GphotoLink>(new GphotoLink(word));
}

void GphotoLink::close() {
  if (library_->camera == nullptr) return;
  gp_camera_exit(library_->camera, library_->context);
  gp_camera_unref(library_->camera);
  library_->camera = nullptr;
  refillStandardInput();
}

Error GphotoLink::failed(int code, const std::string& doing) {
  const std::string what = "The camera " + (library_->model.empty() ? word_ : library_->model) +
                           " " + doing + ": " + gp_result_as_string(code) + ".";
  if (code == GP_ERROR_CANCEL) return cancelled();
  if (code == GP_ERROR_IO_USB_CLAIM || code == GP_ERROR_IO_LOCK) {
    close();
    return {
        Error::Code::kBusy, what,
        "Close the file manager and other programs that show its pictures, and eject it there."};
  }
  if (code == GP_ERROR_CAMERA_BUSY) {
    return {Error::Code::kBusy, what, "Wait until it has written its pictures, then try again."};
  }
  if (code == GP_ERROR_NOT_SUPPORTED) {
    return {Error::Code::kRejected, what, "Set the camera to remote or PTP mode."};
  }
  if (code == GP_ERROR) close();  // what a network camera's lost connection ends in, too
  if (!isLost(code)) return {Error::Code::kIo, what, "Look at the camera's own display."};
  close();
  return {Error::Code::kGone, what,
          "Check that it is on and awake, its battery, and its cable or network."};
}

Result<void> GphotoLink::ensureOpen() {
  if (library_->camera != nullptr) return {};
  FoundCamera found;
  if (word_.starts_with("ptpip:")) {
    found = {kNetworkModel, ptpIpPortFor(word_)};
  } else {
    const auto detected = detect(word_.substr(7), library_->context);
    if (!detected) {
      return Error{Error::Code::kNotFound, "No still camera is found on a USB cable.",
                   "Switch it on, set it to PTP or remote mode, and try again."};
    }
    found = *detected;
  }
  int code = gp_camera_new(&library_->camera);
  if (code >= GP_OK) code = setModel(library_->camera, found.model, library_->context);
  if (code >= GP_OK) code = setPort(library_->camera, found.port);
  if (code >= GP_OK) code = gp_camera_init(library_->camera, library_->context);
  refillStandardInput();
  if (code >= GP_OK) {
    library_->model = found.model;
    const auto model = library_->value({"model", {"cameramodel", "model", nullptr}});
    if (model && !model->empty()) library_->model = *model;
    return {};
  }
  Error error = failed(code, "does not answer");
  close();
  if (error.code == Error::Code::kGone) error.code = Error::Code::kNotFound;
  return error;
}

Result<CameraInfo> GphotoLink::open() {
  if (const auto opened = ensureOpen(); !opened) return opened.error();
  CameraInfo info;
  info.description = library_->model;
  auto told = controls(Controls::kRead);
  if (!told) return told.error();
  info.controls = std::move(told).value();
  return info;
}

Result<cv::Mat> GphotoLink::shoot() {
  if (const auto opened = ensureOpen(); !opened) return opened.error();
  CameraFilePath path{};
  int code = gp_camera_capture(library_->camera, GP_CAPTURE_IMAGE, &path, library_->context);
  if (code < GP_OK) return failed(code, "took no picture");
  for (int waited_ms = 0; !namesJpeg(path.name) && waited_ms < kSecondFile_ms;
       waited_ms += kEventSlice_ms) {
    CameraEventType type{};
    void* event = nullptr;
    code = gp_camera_wait_for_event(library_->camera, kEventSlice_ms, &type, &event,
                                    library_->context);
    if (code >= GP_OK && type == GP_EVENT_FILE_ADDED) path = *static_cast<CameraFilePath*>(event);
    std::free(event);
    if (code < GP_OK) return failed(code, "did not tell of its picture");
  }
  if (!namesJpeg(path.name)) {
    return Error{Error::Code::kRejected,
                 "The camera gives " + std::string(path.name) + ", which is no JPEG picture.",
                 "Set its picture quality to JPEG, the largest and finest."};
  }
  const FileHandle file = newFile();
  code = gp_camera_file_get(library_->camera, path.folder, path.name, GP_FILE_TYPE_NORMAL,
                            file.get(), library_->context);
  if (code < GP_OK) return failed(code, "did not give its picture");
  // It is ours, and the card would fill up. That a camera keeps it does no harm.
  static_cast<void>(
      gp_camera_file_delete(library_->camera, path.folder, path.name, library_->context));
  const char* bytes = nullptr;
  unsigned long size = 0;
  gp_file_get_data_and_size(file.get(), &bytes, &size);
  return decodeWholeJpeg({reinterpret_cast<const unsigned char*>(bytes), size});
}

Result<cv::Mat> GphotoLink::preview() {
  if (const auto opened = ensureOpen(); !opened) return opened.error();
  CameraAbilities abilities;
  gp_camera_get_abilities(library_->camera, &abilities);
  const FileHandle file = newFile();
  const int code = gp_camera_capture_preview(library_->camera, file.get(), library_->context);
  if (code == GP_ERROR_NOT_SUPPORTED) {
    return Error{Error::Code::kRejected, "This camera gives programs no live picture.",
                 "Use its own display; single pictures are taken all the same."};
  }
  if (code < GP_OK) return failed(code, "gave no live picture");
  const char* bytes = nullptr;
  unsigned long size = 0;
  gp_file_get_data_and_size(file.get(), &bytes, &size);
  return decodeWholeJpeg({reinterpret_cast<const unsigned char*>(bytes), size});
}

Result<std::vector<ControlState>> GphotoLink::controls(Controls what) {
  if (const auto opened = ensureOpen(); !opened) return opened.error();
  constexpr std::array kManualFocus = {"manual", "mf"};
  if (what == Controls::kLock) static_cast<void>(library_->choose(kFocus, kManualFocus));
  const std::string program = lowerCase(library_->value(kProgram).value_or(""));
  const bool by_hand = program == "m" || program == "manual" || program == "bulb";
  const bool aperture_by_hand = by_hand || program == "a" || program == "av";
  const auto state = [&](const Names& names, auto is_fixed, const char* cure) {
    ControlState told{names.name, false, 0.0,
                      "The camera does not tell it to programs; set it on the camera itself."};
    const auto value = library_->value(names);
    if (!value) return told;
    told.word = *value;
    told.value = numberInWord(*value);
    told.locked = is_fixed(lowerCase(*value));
    told.remark = told.locked ? "" : cure;
    return told;
  };
  const auto not_automatic = [](const std::string& word) {
    return word.find("auto") == std::string::npos;
  };
  const auto manual = [](const std::string& word) {
    return word.find("manual") != std::string::npos || word == "mf";
  };
  return std::vector<ControlState>{
      state(kFocus, manual, "Set the lens to manual focus (MF)."),
      state(
          kExposure, [&](const std::string&) { return by_hand; },
          "Set the camera's dial to M, and choose the time there."),
      state(
          kAperture, [&](const std::string&) { return aperture_by_hand; },
          "Set the camera's dial to M, and choose the aperture there."),
      state(kGain, not_automatic, "Choose an ISO value in place of automatic."),
      state(kWhiteBalance, not_automatic, "Choose a white balance in place of automatic."),
  };
}

}  // namespace gyre
