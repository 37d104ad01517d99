// Video of the motion, if the browser can record one.

export function canRecord(canvas) {
  return typeof MediaRecorder === "function" && typeof canvas.captureStream === "function";
}

/** Starts a recording. @returns stop(), whose promise gives the video (webm) */
export function record(canvas) {
  const type = ["video/webm;codecs=vp9", "video/webm"].find((each) => MediaRecorder.isTypeSupported(each));
  const recorder = new MediaRecorder(canvas.captureStream(30), {mimeType: type, videoBitsPerSecond: 6e6}), parts = [];
  recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
  recorder.start(250);
  return () => new Promise((resolve) => {
    recorder.addEventListener("stop", () => resolve(new Blob(parts, {type: "video/webm"})), {once: true});
    recorder.stop();
  });
}

export function saveAs(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
