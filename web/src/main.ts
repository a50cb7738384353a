import "./style/base.css";
import "./style/stage.css";
import "./style/panel.css";
import "./style/controls.css";
import "./style/readout.css";
import "./style/touch.css";
import "./style/viewers.css";

import { App } from "./app";
import { decodableCodecs } from "./picture/codecs";
import { openSocket, streamAddress } from "./protocol/connection";
import { takeTokenFromAddress } from "./ui/access";
import { byId } from "./ui/dom";
import { icon } from "./ui/icons";
import { remember, remembered } from "./ui/preferences";

/** Below this width the panel is a sheet over half of the window, and comes up only when asked for. */
const kWide = matchMedia("(min-width: 760px)");

function setUpPanel(): void {
  const page = document.documentElement;
  const toggle = byId("panel-toggle", HTMLButtonElement);
  const panel = byId("panel", HTMLElement);
  const show = (open: boolean) => {
    page.classList.toggle("panel-open", open);
    panel.hidden = !open;
    toggle.setAttribute("aria-expanded", String(open));
    toggle.title = open ? "Hide the panel" : "Show the panel";
  };
  toggle.append(icon("panel"));
  show(kWide.matches && remembered("panel") !== "closed");
  toggle.addEventListener("click", () => {
    const open = panel.hidden;
    show(open);
    if (kWide.matches) remember("panel", open ? "open" : "closed");
  });
}

function setUpDrop(app: App): void {
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", async (event) => {
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (file) app.loadSceneText(await file.text());
  });
}

takeTokenFromAddress(location, history);
setUpPanel();
const app = new App(() => openSocket(streamAddress(location)), await decodableCodecs());
setUpDrop(app);
addEventListener("online", () => app.session.retryNow());
document.addEventListener("visibilitychange", () => {
  if (!document.hidden) app.session.retryNow();
});
// A page kept for the back button holds no connection meanwhile.
addEventListener("pagehide", () => app.session.stop());
addEventListener("pageshow", () => app.session.start());
app.session.start();

Object.defineProperty(window, "sluice", { value: Object.freeze({ facts: () => app.facts() }) });
