// The secret that a server may ask for: from the address's fragment, kept for this tab, or typed in.

import { h } from "./dom";

const kKey = "sluice.token";

/** Takes "#token=…" out of the address, where it would be shared and remembered, and keeps it for this tab. */
export function takeTokenFromAddress(address: Location, history: History): void {
  const { rest, token } = splitFragment(address.hash);
  if (token === undefined) return;
  keep(token);
  history.replaceState(history.state, "", address.pathname + address.search + (rest ? `#${rest}` : ""));
}

/** "#a=1&token=x" → the token "x", and what else the fragment says: "a=1". */
export function splitFragment(hash: string): { token: string | undefined; rest: string } {
  const parts = hash.replace(/^#/, "").split("&");
  const isToken = (part: string) => part.startsWith("token=");
  const given = parts.find(isToken)?.slice("token=".length);
  return { token: given === undefined ? undefined : decoded(given), rest: parts.filter((part) => !isToken(part)).join("&") };
}

function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

let held = "";

export function token(): string {
  try {
    return sessionStorage.getItem(kKey) ?? held;
  } catch {
    return held;
  }
}

function keep(secret: string): void {
  held = secret;
  try {
    sessionStorage.setItem(kKey, secret);
  } catch {
    // Storage is forbidden: it lasts as long as the page.
  }
}

/** Asks for the token over the picture. */
export class TokenPrompt {
  private readonly input = h("input", {
    type: "password",
    class: "text",
    autocomplete: "off",
    "aria-label": "Token",
    required: true,
  });
  private readonly reason = h("p", { class: "complaint", role: "alert" });

  constructor(
    private readonly form: HTMLFormElement,
    onToken: () => void,
  ) {
    const field = h("div", { class: "line" }, this.input, h("button", { type: "submit", class: "primary" }, "Connect"));
    form.append(
      h("h2", {}, "This server asks for a token"),
      h("p", { class: "hint" }, "Whoever runs it can tell you. It is kept for this tab alone."),
      field,
      this.reason,
    );
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      keep(this.input.value);
      this.hide();
      onToken();
    });
  }

  /** `refused` is the server's word about the token that was tried; the first question carries none. */
  show(refused: string): void {
    this.reason.textContent = token() === "" ? "" : refused;
    this.reason.hidden = this.reason.textContent === "";
    this.input.value = "";
    this.form.hidden = false;
    this.input.focus();
  }

  hide(): void {
    this.form.hidden = true;
  }
}
